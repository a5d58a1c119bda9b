#!/usr/bin/env bash
# dev-test.sh SOURCE: ./dev and its scripts help where they are asked to, refuse what is mistyped, and do neither by building anything: they run
# in a copy, where every program that would build or install leaves a mark.
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{programs,copy/bench,copy/papers,copy/build,copy/out}
cp "$source/dev" "$work/copy/"
cp "$source/bench/README.md" "$work/copy/bench/"
cp -r "$source/experiments" "$work/copy/"
cp -r "$source"/papers/*/ "$work/copy/papers/"
for program in cmake ctest dpkg-query apt-get pip tessera; do
  printf '#!/bin/sh\ntouch "%s/ran"\nexit 1\n' "$work" >"$work/programs/$program"
done
chmod +x "$work"/programs/*
export PATH=$work/programs:$PATH TESSERA=$work/programs/tessera
cd "$work/copy"

failed=0
# expect CODE TEXT COMMAND...: its exit code, and a text of what it says.
expect() {
  local code=0 said
  said=$("${@:3}" 2>&1 </dev/null) || code=$?
  if ((code != $1)) || [[ $said != *"$2"* ]] || [[ -e $work/ran ]] || [[ ! -d build || ! -d out ]]; then
    printf 'FAILED: %s: exit code %s, %s\n%s\n' "${*:3}" "$code" "$([[ -e $work/ran ]] && echo 'and something ran' || echo "expected $1: $2")" "$said"
    failed=1
    rm -f "$work/ran"; mkdir -p build out
  fi
}
for command in demo test build bench experiments cluster clean; do
  expect 0 "usage: ./dev $command" ./dev "$command" --help
  expect 0 "usage: ./dev $command" ./dev "$command" -h
  expect 0 "usage: ./dev $command" ./dev help "$command"
  expect 2 "did you mean $command?" ./dev "${command:1:1}${command:0:1}${command:2}"
done
expect 0 'usage: ./dev COMMAND' ./dev
expect 0 'usage: ./dev COMMAND' ./dev --help
expect 0 'usage: ./dev bench' ./dev bench frames --help
expect 0 'usage: ./dev cluster' ./dev cluster sweep.toml out --help
expect 2 "no command 'frobnicate'" ./dev frobnicate
expect 2 "no command 'frobnicate'" ./dev help frobnicate
expect 2 "no benchmark 'nosuch'; there are: frames" ./dev bench nosuch
expect 2 'did you mean frames?' ./dev bench frmaes
expect 2 'no option --fast' ./dev bench variants --fast
expect 2 "no experiment 'nosuch'; there are: bin-capacity" ./dev experiments nosuch
expect 2 'no option --fast' ./dev experiments --fast
expect 2 "clean takes no 'build'" ./dev clean build
expect 2 'which sweep' ./dev cluster
for script in experiments/*.sh papers/*/reproduce.sh; do
  expect 0 'usage: ' "./$script" --help
  expect 2 '' "./$script" --frobnicate
done
exit $failed
