#!/usr/bin/env bash
# Runs experiments, or those named, into out/experiments: sweep, what must hold, report. With --quick small ones into out/experiments-quick,
# whose times mean nothing. With --keep the rows and the figure become the experiment's own. One that was stopped goes on; one that is done is reported
# again, and measured again once its folder is gone.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# All paths are as seen from where the command was typed, which ./dev leaves.
cd "${TESSERA_FROM:-$PWD}"
seen() { realpath -m --relative-to="$PWD" "$1"; }

tessera=${TESSERA:-$here/../build/release/tessera}
python=${TESSERA_PYTHON:-$here/../.tools/report/bin/python}
all=($(cd "$here" && echo */sweep.toml | sed 's:/sweep.toml::g'))
say() { printf '%s\n' "experiments: $*" >&2; }
die() { say "$*"; exit 2; }
# report MODULE ARGUMENTS: a module of the package, whatever lies in the working folder.
report() { PYTHONPATH=$here/report "$python" -P -B -m "tessera_report.$1" "${@:2}"; }

root=${TESSERA_OUT:-$(seen "$here/../out")}
quick=() out=$root/experiments keep=false check=false names=()
for argument; do
  argument=${argument%/}
  case $argument in
    --quick) quick=(--quick) out=$root/experiments-quick ;;
    --keep) keep=true ;;
    --check) check=true ;;  # ./dev experiments asks before it builds
    -h | --help)
      echo 'usage: experiments/run.sh [--quick] [--keep] [NAME...], or ./dev experiments, which builds first'
      sed -n '2,/^set/{s/^# //p}' "$here/run.sh"
      exit 0 ;;
    -*) die "no option $argument; --quick and --keep are there" ;;
    *) [[ -f $here/$argument/sweep.toml ]] || die "no experiment '$argument'; there are: ${all[*]}"
       names+=("$argument") ;;
  esac
done
$keep && ((${#quick[@]})) && die "--keep: rows of --quick are not kept, their times mean nothing"
! $check || exit 0
((${#names[@]})) || names=("${all[@]}")

failed=()
for name in "${names[@]}"; do
  folder=$out/$name own=$(seen "$here/$name")
  # A quick run is done in seconds, and begins anew; what another version of the sweep file left is put aside, not removed.
  if [[ -d $folder ]] && { ((${#quick[@]})) || ! cmp -s "$own/sweep.toml" "$folder/sweep.toml"; }; then
    rm -rf "$folder.before" && mv "$folder" "$folder.before"
  fi
  mkdir -p "$out"
  resume=()
  [[ ! -f $folder/journal.jsonl ]] || resume=(--resume)
  say "$name"
  code=0
  "$tessera" sweep "$own/sweep.toml" --out "$folder" --allow-kernels "${quick[@]}" "${resume[@]}" >"$folder.txt" || code=$?
  ((code != 130)) || exit 130  # Ctrl-C stops them all
  ((code == 0)) || { cat "$folder.txt"; failed+=("$name"); continue; }
  report expect "$folder" || code=$?
  "$tessera" report "$folder" || code=$?
  ((code == 0)) || { failed+=("$name"); continue; }
  if $keep; then
    [[ -f $folder/report/figures/figure.svg ]] || die "$name: its rows give no figure.svg; [plot] in its sweep.toml chooses it"
    for pair in rows.jsonl:results.jsonl report/figures/figure.svg:figure.svg; do
      new=$(mktemp "$own/${pair#*:}.XXXXXX")
      cp "$folder/${pair%:*}" "$new" && chmod 644 "$new" && mv "$new" "$own/${pair#*:}"
    done
  fi
done
# Over all that are there, those of earlier runs, too.
reported=()
for name in "${all[@]}"; do [[ ! -f $out/$name/rows.jsonl ]] || reported+=("$name"); done
if ((${#reported[@]})); then
  report index "$out" "${reported[@]}" --schema "$(sed -n 's/.*kRowSchemaVersion = \([0-9]*\);/\1/p' "$here/../host/measure/row.h")"
fi
((${#failed[@]} == 0)) || { say "failed: ${failed[*]}"; exit 5; }
