#!/usr/bin/env bash
# Times one picture by Lobelia, POV-Ray and Cycles, one thread each, in turn: the whole command, and the tracing alone as
# the engine reports it. Prints medians, and the ratio to ours.
#
# POV-Ray's tracing is the "Trace Time" of its statistics. Cycles' is the time from its first to its last sample, which
# it prints in hundredths of a second.
set -euo pipefail
lobelia=$1
speed=$2
scene=$3
rounds=5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

wall() {  # NAME COMMAND...: adds the wall seconds to $work/NAME
  local name=$1 start end
  shift
  start=$(date +%s%N)
  "$@" >"$work/log" 2>&1 || { echo "$name failed:" >&2; cat "$work/log" >&2; exit 1; }
  end=$(date +%s%N)
  awk -v ns=$((end - start)) 'BEGIN { printf "%.6f\n", ns / 1e9 }' >>"$work/$name"
}
median() { sort -n "$1" | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
hundredths() {  # seconds of "Time:MM:SS.CC" in the last line with the words
  grep -- "$1" "$work/log" | tail -1 | sed 's/.*Time:\([0-9]*\):\([0-9.]*\).*/\1 \2/' | awk '{ print $1 * 60 + $2 }'
}

engines=()
command -v povray >/dev/null && engines+=(povray)
command -v blender >/dev/null && engines+=(blender)
size=(--width 1024 --height 1024)

for lobe in cosine cs16; do
  rm -rf "${work:?}"/*
  "$lobelia" scene-format >/dev/null
  sed "s/<string name=\"lobe\" value=\"[a-z0-9]*\"/<string name=\"lobe\" value=\"$lobe\"/" "$scene" >"$work/scene.xml"
  for engine in "${engines[@]}"; do
    "$lobelia" reference "$work/scene.xml" --engine "$engine" "${size[@]}" --threads 1 -q -o "$work/$engine.exr" \
      --keep-input "$work/$engine.in"
  done
  for ((round = 0; round < rounds; ++round)); do
    wall lobelia "$lobelia" render "$work/scene.xml" "${size[@]}" --threads 1 -q -o "$work/ours.exr"
    for engine in "${engines[@]}"; do
      wall "$engine" "$lobelia" reference "$work/scene.xml" --engine "$engine" "${size[@]}" --threads 1 -q -o "$work/$engine.exr"
      case $engine in
        povray)
          sed -i 's/^Statistic_Console=off/Statistic_Console=on/' "$work"/povray.in/*.ini
          (cd "$work/povray.in" && sh povray.sh) >"$work/log" 2>&1
          sed -n 's/.*Trace Time.*(\([0-9.]*\) seconds).*/\1/p' "$work/log" >>"$work/povray.trace" ;;
        blender)
          sed -i 's/"threads": *[0-9]*/"threads": 1/' "$work/blender.in/job.json"
          (cd "$work/blender.in" && bash blender.sh) >"$work/log" 2>&1
          awk -v a="$(hundredths 'Sample 0/')" -v b="$(hundredths 'Sample 1/1$')" 'BEGIN { print b - a }' >>"$work/blender.trace" ;;
      esac
    done
  done
  # The timed pictures must agree, or differ only by the rounding of half floats.
  for engine in "${engines[@]}"; do
    "$lobelia" compare "$work/ours.exr" "$work/$engine.exr" >"$work/log" 2>&1 || [ $? = 1 ] ||
      { cat "$work/log" >&2; exit 1; }
  done

  echo
  echo "head-on, $lobe, 1024 x 1024, one thread: seconds, median of $rounds interleaved rounds, and the ratio to ours"
  "$speed" trace "$work/scene.xml" >"$work/ours.trace"
  printf '%-10s %12s' engine 'whole'
  awk '{ printf " %12s", "ratio" } END { printf " %12s", "trace" }' /dev/null
  while read -r set _; do printf ' %18s' "ratio $set"; done <"$work/ours.trace"
  echo
  ours=$(median "$work/lobelia")
  printf '%-10s %12.3f %12s %12s' lobelia "$ours" 1 ''
  while read -r _ seconds; do printf ' %16.5f s' "$seconds"; done <"$work/ours.trace"
  echo
  least=1e9
  for engine in "${engines[@]}"; do
    whole=$(median "$work/$engine") traced=$(median "$work/$engine.trace")
    printf '%-10s %12.3f %12.1f %12.3f' "$engine" "$whole" "$(awk "BEGIN { print $whole / $ours }")" "$traced"
    while read -r _ seconds; do printf ' %18.0f' "$(awk "BEGIN { print $traced / $seconds }")"; done <"$work/ours.trace"
    echo
    least=$(awk "BEGIN { print ($whole < $least) ? $whole : $least }")
  done
  awk -v ours="$ours" -v trace="$(tail -1 "$work/ours.trace" | cut -d' ' -f2)" 'BEGIN {
    printf "Limit: %s. Tracing is %.0f %% of our whole command.\n",
      trace < 0.5 * ours ? "start-up and the file" : "tracing", 100 * trace / ours }'
done
