#!/usr/bin/env bash
# Renders a real mesh and a generated one on the CPU and on a Vulkan device, shaded, into out/demo/; compares the two devices'
# images with each other and with the oracle, and prints what each did and how long its stages took.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tessera=${TESSERA:-build/release/tessera}
size=${TESSERA_DEMO_SIZE:-1024x1024}
mesh=refined_elephant.off
meshHash=a170eed4ef33ef412a72b824d791f69ea59ee5f5a7c12dc1ae9077b6eb030650   # of Debian 12's libcgal-demo 5.5.1

if (($#)); then
  case $1 in
    -h | --help) echo 'usage: experiments/demo.sh, or ./dev demo, which builds first'; sed -n '2,/^set/{s/^# //p}' experiments/demo.sh; exit 0 ;;
    *) echo "demo: takes no '$1'; --help says what it does" >&2; exit 2 ;;
  esac
fi

say() { printf '%s\n' "demo: $*" >&2; }
[[ -x $tessera ]] || { say "$tessera is not there: ./dev demo builds it first"; exit 1; }

# One mesh of Debian's libcgal-demo, unpacked once, beside its name and renamed.
if [[ ! -f build/data/$mesh ]]; then
  archive=$(dpkg-query -L libcgal-demo 2>/dev/null | grep '/data\.tar\.gz$' | head -n 1) || true
  [[ $archive && -f $archive ]] || { say "Debian's libcgal-demo is not installed: apt-get install libcgal-demo"; exit 1; }
  mkdir -p build/data
  new=$(mktemp -d build/data/unpacked.XXXXXX)
  trap 'rm -rf "$new"' EXIT
  tar -xzOf "$archive" --wildcards "*/$mesh" >"$new/$mesh"
  mv "$new/$mesh" "build/data/$mesh"
fi
sha256sum --status -c <<<"$meshHash  build/data/$mesh" ||
  say "note: build/data/$mesh is not the one of Debian 12, so its figures are others"

mkdir -p out/demo
# demo NAME INPUT
demo() {
  local name=out/demo/$1 input=$2 device
  for device in cpu vulkan; do
    say "$1 on $device"
    "$tessera" render "$input" --size "$size" --device "$device" --set shade=smooth \
      -o "$name-$device.png" -o "$name-$device.exr" --json "$name.jsonl" >/dev/null
  done
  "$tessera" compare "$name-cpu.exr" "$name-vulkan.exr" -o "$name-difference.png" >"$name-compare.txt" ||
    { cat "$name-compare.txt"; return 5; }
  "$tessera" parity "$input" --size "$size" --device cpu --device vulkan --set shade=smooth --repeat 3 \
    --json "$name.jsonl" --replay "$name-difference.replay"
  echo
}
demo elephant "build/data/$mesh"
demo icosphere 'generate:icosphere?level=7'
echo "images and result rows: $(pwd)/out/demo"
