// Asks Tint, the WGSL compiler of Chromium, about WGSL files. Tint checks what naga does not: the uniformity of
// control flow around derivatives and implicit-level texture sampling in fragment shaders.
//
//   node check.mjs FOLDER      every .wgsl file below the folder
//   node check.mjs < LIST      every file named in LIST, one a line
//
// Prints {"files": N, "errors": [{file, line, column, message}], "warnings": [...]} and exits 0 if there is no error,
// 1 if there is one, 2 if the check itself did not work.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

function listed() {
  const folder = process.argv[2];
  if (folder === undefined) {
    return readFileSync(0, 'utf8').split('\n').map((line) => line.trim()).filter((line) => line !== '');
  }
  return readdirSync(folder, { recursive: true })
    .filter((name) => name.endsWith('.wgsl'))
    .sort()
    .map((name) => join(folder, name));
}

// Dawn frees what JavaScript no longer reaches, even while a device made from it is in use.
const dawn = (globalThis.dawn = {});

async function main() {
  const { create, globals } = await import('webgpu');
  Object.assign(globalThis, globals);
  // The null backend compiles WGSL without any GPU or driver.
  dawn.gpu = create(['backend=null']);
  const adapter = (dawn.adapter = await dawn.gpu.requestAdapter());
  if (adapter === null) {
    throw new Error('Dawn offers no null adapter');
  }
  const device = (dawn.device = await adapter.requestDevice());
  device.addEventListener?.('uncapturederror', (event) => event.preventDefault?.());

  const files = listed();
  const result = { files: files.length, errors: [], warnings: [] };
  for (const file of files) {
    device.pushErrorScope('validation');
    const module = device.createShaderModule({ label: file, code: readFileSync(file, 'utf8') });
    const { messages } = await module.getCompilationInfo();
    const scope = await device.popErrorScope();
    for (const { type, lineNum, linePos, message } of messages) {
      const list = type === 'error' ? result.errors : result.warnings;
      list.push({ file, line: lineNum, column: linePos, message });
    }
    if (scope !== null && !messages.some((m) => m.type === 'error')) {
      result.errors.push({ file, line: 0, column: 0, message: scope.message });
    }
  }
  console.log(JSON.stringify(result, null, 1));
  return result.errors.length === 0 ? 0 : 1;
}

try {
  // Dawn keeps the event loop alive, so the end is explicit.
  process.exit(await main());
} catch (error) {
  console.error(`tint check did not work: ${error.message}`);
  process.exit(2);
}
