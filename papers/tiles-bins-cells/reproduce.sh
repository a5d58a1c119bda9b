#!/usr/bin/env bash
# main.pdf from the rows in experiments/; --fresh runs the three sweeps first and takes their rows; --resume goes on with sweeps that
# were broken off.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
out=$root/out/papers/tiles-bins-cells
sweeps=(tile-size bin-capacity pineda-cells)
die() { printf '%s\n' "reproduce: $1" >&2; exit "${2:-1}"; }

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  echo 'usage: papers/tiles-bins-cells/reproduce.sh [--fresh | --resume]'
  sed -n '2,/^set/{s/^# //p}' "${BASH_SOURCE[0]}"
  exit 0
fi
(($# <= 1)) && [[ ${1:-} == '' || $1 == --fresh || $1 == --resume ]] || die "usage: reproduce.sh [--fresh | --resume]" 2
[[ -f $root/.tools/report/pinned ]] || die ".tools/report: Python with Typst is not there; ./dev build installs it"
python=$root/.tools/report/bin/python

mkdir -p "$out"
folders=()
for name in "${sweeps[@]}"; do
  if [[ ${1:-} == '' ]]; then
    rows=$root/experiments/$name/results.jsonl
    [[ -f $rows ]] || die "experiments/$name/results.jsonl: not there; --fresh runs the sweep, and ./dev experiments --keep $name puts its rows there"
    mkdir -p "$out/kept/$name"
    cp "$rows" "$out/kept/$name/rows.jsonl"
    cp "$root/experiments/$name/sweep.toml" "$out/kept/$name/"
    folders+=("$out/kept/$name")
  else
    tessera=$root/build/release/tessera
    [[ -x $tessera ]] || die "build/release/tessera: not there; ./dev build builds it"
    folder=$out/fresh/$name
    [[ $1 == --resume ]] || rm -rf "$folder"
    "$tessera" sweep "$root/experiments/$name/sweep.toml" --out "$folder" $([[ ! -d $folder ]] || echo --resume)
    folders+=("$folder")
  fi
done
"$python" "$here/values.py" "$out" "${folders[@]}"
"$python" "$here/../typeset.py" "$here/main.typ" "$out" "$here/main.pdf"
echo "wrote ${here#"$root/"}/main.pdf"
