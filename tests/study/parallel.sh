#!/usr/bin/env bash
# One study on several "machines": its parts run as jobs of GNU parallel, and their results are put together.
#
#   tests/study/parallel.sh BINARY
#
# Needs GNU parallel.
set -euo pipefail

binary="$(realpath "$1")"
here="$(cd "$(dirname "$0")/../.." && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cat >"$work/study.ron" <<RON
Study(
    version: 1,
    title: "parts",
    plain: "hard",
    rounds: 2,
    warm_up: 0,
    truth: (references: ["rays"], size: (48, 36), samples: 16),
    cases: {
        "one": (scene: "$here/graphs/studies/scenes/one_layer.ron", light: "spot"),
        "two": (scene: "$here/graphs/studies/scenes/two_layers.ron", light: "spot"),
        "standing": (scene: "$here/graphs/studies/scenes/contact.ron", light: "spot"),
    },
    methods: {"hard": (shadow: "hard_shadow"), "VSM": (shadow: "variance_shadow")},
    grids: [(frames: [(48, 36)], vary: {"size": [64, 128]})],
)
RON
cd "$work"
parallel --will-cite --halt soon,fail=1 -j2 "$binary" study study.ron -o part{} --shard {}/3 ::: 1 2 3 >/dev/null
"$binary" study merge part1 part2 part3 -o whole >/dev/null
"$binary" study study.ron --list | sort >expected
# What was merged is all there is to measure.
grep -o '"cell":"[^"]*"' whole/results.jsonl | cut -d'"' -f4 | sort >found
diff expected found
told="$("$binary" study study.ron -o whole --format json)"
case "$told" in
    *'"measured":0'*) echo "parallel: $(wc -l <found) cells in three parts, put together" ;;
    *) echo "parallel: cells were measured again: $told" >&2; exit 1 ;;
esac
