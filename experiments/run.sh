#!/usr/bin/env bash
# Runs experiments, or those named, into out/experiments: sweep, what must hold, report. With --quick small ones into out/experiments-quick,
# whose times mean nothing. With --keep the rows and the figure become the experiment's own. One that was stopped goes on; one that is done is reported
# again, and measured again once its folder is gone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

tessera=${TESSERA:-$PWD/../build/release/tessera}
python=${TESSERA_PYTHON:-$PWD/../.tools/report/bin/python}
say() { printf '%s\n' "experiments: $*" >&2; }
die() { say "$*"; exit 2; }

root=${TESSERA_OUT:-../out}
quick=() out=$root/experiments keep=false check=false names=()
for argument; do
  argument=${argument%/}
  case $argument in
    --quick) quick=(--quick) out=$root/experiments-quick ;;
    --keep) keep=true ;;
    --check) check=true ;;  # ./dev experiments asks before it builds
    -h | --help)
      echo 'usage: experiments/run.sh [--quick] [--keep] [NAME...], or ./dev experiments, which builds first'
      sed -n '2,/^set/{s/^# //p}' "${BASH_SOURCE[0]##*/}"
      exit 0 ;;
    -*) die "no option $argument; --quick and --keep are there" ;;
    *) [[ -f $argument/sweep.toml ]] || die "no experiment '$argument'; there are: $(echo */sweep.toml | sed 's:/sweep.toml::g')"
       names+=("$argument") ;;
  esac
done
$keep && ((${#quick[@]})) && die "--keep: rows of --quick are not kept, their times mean nothing"
! $check || exit 0
((${#names[@]})) || names=($(echo */sweep.toml | sed 's:/sweep.toml::g'))

failed=()
for name in "${names[@]}"; do
  folder=$out/$name
  # A quick run is done in seconds, and begins anew; what another version of the sweep file left is put aside, not removed.
  if [[ -d $folder ]] && { ((${#quick[@]})) || ! cmp -s "$name/sweep.toml" "$folder/sweep.toml"; }; then
    rm -rf "$folder.before" && mv "$folder" "$folder.before"
  fi
  mkdir -p "$out"
  resume=()
  [[ ! -f $folder/journal.jsonl ]] || resume=(--resume)
  say "$name"
  code=0
  "$tessera" sweep "$name/sweep.toml" --out "$folder" --allow-kernels "${quick[@]}" "${resume[@]}" >"$folder.txt" || code=$?
  ((code != 130)) || exit 130  # Ctrl-C stops them all
  ((code == 0)) || { cat "$folder.txt"; failed+=("$name"); continue; }
  "$python" report/expect.py "$folder" || code=$?
  "$tessera" report "$folder" || code=$?
  ((code == 0)) || { failed+=("$name"); continue; }
  if $keep; then
    [[ -f $folder/report/figures/figure.svg ]] || die "$name: its rows give no figure.svg; [plot] in its sweep.toml chooses it"
    for pair in rows.jsonl:results.jsonl report/figures/figure.svg:figure.svg; do
      cp "$folder/${pair%:*}" "$name/${pair#*:}.tmp" && mv "$name/${pair#*:}.tmp" "$name/${pair#*:}"
    done
  fi
done
((${#failed[@]} == 0)) || { say "failed: ${failed[*]}"; exit 5; }
