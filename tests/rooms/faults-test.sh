#!/bin/sh
# Faults are put into a copy of the sources; rooms-test.py has to name each.
set -eu
here=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/experiments"
cp -r "$source/host" "$source/datasets" "$source/slang" "$source/bench" "$work"
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
#include "host/frame/dispatcher.h"' 'support includes host/frame/dispatcher.h of frame'
broken host/include/tessera/error.h '#include <tessera/scene.h>
#include <nlohmann/json.hpp>' 'host/include/tessera/error.h: a public header, and includes nlohmann'
broken host/include/tessera/framebuffer.h '#include <tessera/rasterizer.h>' 'a circle of includes: '
broken datasets/text.h '#include "datasets/no-such.h"' 'datasets/text.h: includes datasets/no-such.h, which is not there'
broken host/support/text.h 'namespace tessera { int one(); }' 'host/support/text.h: declares into tessera, and tessera::support would be right'
broken host/plan/bins.h 'namespace tessera { namespace frame { int one(); } }' 'host/plan/bins.h: declares into tessera::frame, and tessera::plan would be right'
broken host/include/tessera/error.h 'namespace tessera::support { int one(); }' 'host/include/tessera/error.h: declares into tessera::support, and tessera would be right'
broken host/frame/tally.cpp 'namespace tessera::plan { int one() { return 1; } }' 'host/frame/tally.cpp: declares into tessera::plan, and tessera::frame would be right'
broken datasets/text.h 'int one();' 'datasets/text.h: declares into no namespace, and tessera::datasets would be right'
broken bench/suite.h 'namespace tessera { int one(); }' 'bench/suite.h: declares into tessera, and tessera::bench would be right'
broken slang/math/exact-math.slang 'import layout;' 'slang-math imports layout, which reads slang/records/layout.slang of slang-records'
broken slang/machine/workgroup.slang '__exported import fixed_point;' 'slang-machine imports fixed_point, which reads slang/math/fixed-point.slang'
broken slang/geometry/coverage.slang 'import variant;' 'slang-geometry imports variant, which reads slang/axes/'
broken slang/axes/commit/count.slang 'public import resolve;' 'slang-axes imports resolve, which reads slang/stages/resolve.slang'
broken slang/axes/binning/lists.slang '#include "stages/clear.slang"' 'slang-axes imports stages/clear.slang, which reads slang/stages/clear.slang'
broken slang/geometry/clip.slang 'import project;' 'a circle of imports: '
broken slang/geometry/work.slang 'import no_such;' 'slang/geometry/work.slang: imports no_such, which is not there'
broken slang/geometry/work.slang '#ifdef TESSERA_CPP
#endif' 'slang/geometry/work.slang: knows its target (TESSERA_CPP)'
broken slang/geometry/work.slang '[numthreads(1, 1, 1)] void work() {}' 'slang/geometry/work.slang: an entry point, and not in slang-stages'
broken slang/axes/edge/int64.slang 'implementing settings;' 'slang/axes/edge/int64.slang: a part of settings, and not in slang-wide'
broken slang/axes/cells.slang 'module work;' 'a second module work, beside '
