#!/usr/bin/env bash
# Whole commands, from start to picture on the disk: ours, POV-Ray and Blender on one scene, in turn,
# seven times; minimum, median and maximum of wall seconds, and the ratio of the medians to ours.
set -euo pipefail
lobelia=$1
scene=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

measure() {  # NAME COMMAND...: adds the wall time to $work/NAME
  local name=$1 start end
  shift
  start=$(date +%s%N)
  "$@" >"$work/log" 2>&1 || { echo "$name failed:" >&2; cat "$work/log" >&2; exit 1; }
  end=$(date +%s%N)
  echo $(((end - start) / 1000)) >>"$work/$name"
}

engines=()
command -v povray >/dev/null && engines+=(povray)
command -v blender >/dev/null && engines+=(blender)
for _ in 1 2 3 4 5 6 7; do
  measure lobelia "$lobelia" render "$scene" --width 1024 --height 1024 -q -o "$work/l.exr"
  for engine in "${engines[@]}"; do
    measure "$engine" "$lobelia" reference "$scene" --engine "$engine" --width 1024 --height 1024 \
      -q -o "$work/$engine.exr"
  done
done

echo
echo "whole command, head-on scene, 1024 x 1024, wall seconds (references: with our reading and writing)"
printf '%-10s %8s %8s %8s %8s\n' engine min median max ratio
ours=$(sort -n "$work/lobelia" | sed -n 4p)
for name in lobelia "${engines[@]}"; do
  sort -n "$work/$name" | awk -v name="$name" -v ours="$ours" '
    { v[NR] = $1 }
    END { printf "%-10s %8.3f %8.3f %8.3f %8.1f\n", name, v[1]/1e6, v[4]/1e6, v[NR]/1e6, v[4]/ours }'
done
