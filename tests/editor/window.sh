#!/usr/bin/env bash
# The real window, on a display of its own: opens an example, edits it by pointer and keys, saves, takes pictures of the
# screen and quits. Says what it saw; ends with 0 only if all of it held.
#
#   tests/editor/window.sh BINARY [FOLDER]
#
# FOLDER gets the pictures. Needs xvfb, xdotool and imagemagick.
set -euo pipefail

binary="$(realpath "$1")"
size="${SIZE:-1280x800}"
mkdir -p "${2:-.}"
# Whole, as this goes to another folder below.
pictures="$(realpath "${2:-$(mktemp -d)}")"
here="$(cd "$(dirname "$0")/../.." && pwd)"
work="$(mktemp -d)"
pids=()
finish() {
    for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
    rm -rf "$work"
}
trap finish EXIT
fail() {
    echo "window: $*" >&2
    import -window root "$pictures/failed.png" 2>/dev/null || true
    sed 's/^/  editor: /' "$work/editor.log" >&2 || true
    exit 1
}

export XDG_CONFIG_HOME="$work/config" XDG_STATE_HOME="$work/state" XDG_CACHE_HOME="$work/cache"
if [ -z "${XDG_RUNTIME_DIR:-}" ]; then
    export XDG_RUNTIME_DIR="$work"
fi
mkdir -p "$XDG_CONFIG_HOME/shadetree"
cat >"$XDG_CONFIG_HOME/shadetree/editor.json" <<JSON
{"version": 1, "dark": ${DARK:-true}, "welcomed": true}
JSON

exec 3<>"$work/display"
Xvfb -displayfd 3 -screen 0 "${size}x24" >"$work/xvfb.log" 2>&1 &
pids+=($!)
for _ in $(seq 100); do [ -s "$work/display" ] && break; sleep 0.1; done
DISPLAY=":$(head -n1 "$work/display")"
export DISPLAY
unset WAYLAND_DISPLAY

cp -r "$here/graphs" "$work/graphs"
cd "$work"
graph=graphs/surfaces/bumpy_glass.ron
before="$(sha256sum <"$graph")"
"$binary" edit "$graph" >"$work/editor.log" 2>&1 &
editor=$!
pids+=("$editor")

window=""
for _ in $(seq 300); do
    window="$(xdotool search --onlyvisible --name 'shadetree' 2>/dev/null | head -n1 || true)"
    [ -n "$window" ] && break
    kill -0 "$editor" 2>/dev/null || fail "the editor ended before it had a window"
    sleep 0.2
done
[ -n "$window" ] || fail "no window"
xdotool windowmove "$window" 0 0 windowsize "$window" "${size%x*}" "${size#*x}" || true
xdotool windowfocus "$window" || true
sleep "${SETTLE:-12}"
import -window root "$pictures/opened.png"

middle_x=$(( ${size%x*} * 40 / 100 ))
middle_y=$(( ${size#*x} * 35 / 100 ))
xdotool mousemove "$middle_x" "$middle_y"
sleep 0.5
# Add a node by its search list.
xdotool key shift+a
sleep 1
xdotool type --delay 60 "perlin"
sleep 1
import -window root "$pictures/finder.png"
xdotool key Return
sleep 1
# Drag the canvas, which changes nothing, and zoom.
xdotool mousemove "$middle_x" "$(( ${size#*x} * 60 / 100 ))" mousedown 2 mousemove_relative 40 10 mouseup 2
xdotool click 4 click 5
sleep 1
xdotool key ctrl+s
for _ in $(seq 50); do
    [ "$(sha256sum <"$graph")" != "$before" ] && break
    sleep 0.2
done
[ "$(sha256sum <"$graph")" != "$before" ] || fail "Ctrl+S wrote nothing"
grep -q perlin "$graph" || fail "the saved graph has no new node"
"$binary" fmt --check "$graph" || fail "the saved graph is not in canonical form"
# Take it back, and save again: the file is as it was.
xdotool key ctrl+z
sleep 1
xdotool key ctrl+s
for _ in $(seq 50); do
    [ "$(sha256sum <"$graph")" = "$before" ] && break
    sleep 0.2
done
[ "$(sha256sum <"$graph")" = "$before" ] || fail "undo and save did not bring the file back"
sleep 4
import -window root "$pictures/edited.png"
colors="$(identify -format %k "$pictures/edited.png")"
[ "$colors" -gt 500 ] || fail "the window looks empty: $colors colours"
xdotool key ctrl+q
for _ in $(seq 100); do
    kill -0 "$editor" 2>/dev/null || break
    sleep 0.1
done
kill -0 "$editor" 2>/dev/null && fail "Ctrl+Q did not quit"
status=0
wait "$editor" || status=$?
[ "$status" -eq 0 ] || fail "the editor ended with $status"
[ -z "$(find "$XDG_STATE_HOME" -name '*.json' 2>/dev/null)" ] || fail "something was left to recover"
echo "window: opened, edited, saved, undone and quit; pictures in $pictures"
