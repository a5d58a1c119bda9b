#!/bin/sh
# Faults are put into a copy of the sources; rooms-test.py has to name each.
set -eu
here=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/experiments"
cp -r "$source/host" "$source/datasets" "$work"
cp -r "$source/experiments/harness" "$work/experiments"
python3 "$here/rooms-test.py" "$work"
broken() { # file, line that it gets, what the test has to say
  cp "$work/$1" "$work/kept"
  printf '%s\n' "$2" >> "$work/$1"
  if said=$(python3 "$here/rooms-test.py" "$work"); then
    echo "not found: $2 in $1"
    exit 1
  fi
  case $said in
    *"$3"*) ;;
    *) echo "'$3' is not in: $said"; exit 1 ;;
  esac
  mv "$work/kept" "$work/$1"
}
broken host/support/files.h '#include <tessera/rasterizer.h>
#include "host/frame/dispatcher.h"' 'support includes host/frame/passes.h of frame'
broken host/include/tessera/error.h '#include <tessera/scene.h>
#include <nlohmann/json.hpp>' 'host/include/tessera/error.h: a public header, and includes nlohmann'
broken host/include/tessera/framebuffer.h '#include <tessera/rasterizer.h>' 'a circle of includes: '
broken datasets/text.h '#include "datasets/no-such.h"' 'datasets/text.h: includes datasets/no-such.h, which is not there'
