#!/usr/bin/env bash
# Installs the renderers and libraries that the reference is compared with into the folder given: POV-Ray and Tachyon from Debian,
# Mitsuba 3 and Embree 4 from PyPI (Mitsuba's LLVM from Debian), ODiff from npm, dify and libraries
# from crates.io. Needs g++, cargo, Python 3, npm and, for Debian's packages, root unless
# they are there.
set -euo pipefail
ours=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
stamp=$(cat "$ours/install.sh" "$ours/requirements.txt" "$ours/embree.cpp" "$ours/crates/Cargo.lock" "$ours"/crates/src/*.rs | cksum)
[ "$(cat "$folder/stamp" 2> /dev/null)" != "$stamp" ] || exit 0

say() { printf '%s\n' "$*" >&2; }

say "POV-Ray, Tachyon, LLVM"
packages=()
command -v povray > /dev/null || packages+=(povray)
command -v tachyon > /dev/null || packages+=(tachyon)
llvm() { ldconfig -p | awk '/libLLVM[-.](so\.)?(19|2[0-9])/ { print $NF; exit }'; }
[ -n "$(llvm)" ] || packages+=(libllvm19)
if [ "${#packages[@]}" -gt 0 ]; then
    [ "$(id -u)" = 0 ] || { say "install these packages first, as root: ${packages[*]}"; exit 1; }
    apt-get update > /dev/null
    apt-get install -y --no-install-recommends "${packages[@]}" > /dev/null
    ldconfig
fi

# what Mitsuba compiles its kernels with; 15, Debian's default, is too old for it
ln -sf "$(llvm)" "$folder/libLLVM.so"

say "Mitsuba 3, Embree 4"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check -r "$ours/requirements.txt"
# Embree comes as a library inside a wheel, whose file names carry a hash
libraries=("$folder"/venv/lib/python3*/site-packages/embreex.libs)
embree=$(ls "${libraries[0]}"/libembree4-*.so.4)
g++ -O3 -march=native -std=c++17 "$ours/embree.cpp" "$embree" -Wl,-rpath,"${libraries[0]}" -o "$folder/embree"

say "ODiff, dify"
npm install --prefix "$folder" --no-audit --no-fund --loglevel=error odiff-bin@4.5.0 > /dev/null
# itself, without the Node.js that starts it
ln -sf "$(find "$folder/node_modules/@odiff" -type f -perm -u+x | head -1)" "$folder/odiff"
CARGO_TARGET_DIR="$folder/crates" cargo install --quiet --locked --root "$folder/dify" --version 0.8.0 dify

say "crates"
CARGO_TARGET_DIR="$folder/crates" cargo build --release --quiet --locked --manifest-path "$ours/crates/Cargo.toml"

echo "$stamp" > "$folder/stamp"
