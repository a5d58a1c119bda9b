#!/usr/bin/env bash
# completion-test.sh PROGRAM: what bash completes, by its own function, as readline would call it.
set -uo pipefail
PATH=$(dirname "$1"):$PATH
source <(tessera completion bash) || exit 1
compopt() { :; }  # there is no line that is being edited
cd "$(mktemp -d)" && touch mine.comp other.txt && mkdir folder

failed=0
# completes LINE WORD...: these words are among what may come at the line's end; !WORD: not.
completes() {
  COMP_LINE=$1 COMP_POINT=${#1}
  COMP_WORDS=($1) COMPREPLY=()
  _tessera
  local word list=" ${COMPREPLY[*]} "
  for word in "${@:2}"; do
    if [[ $word == !* ]] && [[ $list != *" ${word:1} "* ]]; then continue; fi
    [[ $word != !* && $list == *" $word "* ]] || { echo "FAILED: '$1' and $word:$list"; failed=1; }
  done
}
completes 'tessera ' render parity completion '!complete' '!sweep-worker'
completes 'tessera ren' render '!parity'
completes 'tessera help p' parity plan
completes 'tessera render --' --size --set --quiet --device
completes 'tessera compare --si' '!--size'
completes 'tessera render --set ti' tile= tile-test= '!commit='
completes 'tessera render --set tile=' 8 16 32 64            # readline breaks words at =
completes 'tessera render --set tile=8,commit=two' two-pass
completes 'tessera render --set=cull=' none back front
completes 'tessera render --device vul' vulkan vulkan:0
completes 'tessera render --device vulkan:' 0                # and at the colon
completes 'tessera render me' mesh:
completes 'tessera render mesh:refined_' refined_elephant
completes 'tessera render --error me' mesh:                  # a flag is followed by no value
completes 'tessera render generate:ico' icosphere
completes "tessera render 'generate:layers?order=" 'generate:layers?order=far-to-near'  # but not within quotes
completes 'tessera render --kernel sha' shade=
completes 'tessera render --kernel shade=' mine.comp other.txt folder
completes 'tessera render -o ' mine.comp folder
completes 'tessera render --repeat 3 -o x.png fo' folder
completes 'tessera render mine.comp ' '!mine.comp'           # one input is enough
completes 'tessera sweep a.toml --out ' folder '!mine.comp'
completes 'tessera compare a.exr b.exr --tolerance ' depth= values= colour= '!mine.comp'
completes 'tessera compare a.exr b.exr --at-most=de' depth=
completes 'tessera compare a.exr b.exr --tolerance depth=' '!mine.comp' '!depth='
completes 'tessera compare a.exr b.exr --allow ' '!mine.comp'
completes "tessera render mine.comp -o png:$PWD/mi" "$PWD/mine.comp"
completes "tessera render mine.comp -o exr:" mine.comp folder
completes "tessera render mine.comp --output=png:mi" mine.comp
completes "tessera render mine.comp -o 'png:mi" png:mine.comp  # quotes keep the word whole
completes "tessera render mine.comp --json png:mi" '!mine.comp'
completes 'tessera report folder --out ' folder '!mine.comp'
completes 'tessera mes' meshes
completes 'tessera kernels --emit w' wgsl
completes 'tessera kernels --emit wgsl ' folder '!mine.comp'
completes 'tessera completion ' bash zsh fish
exit $failed
