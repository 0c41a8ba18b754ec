#!/usr/bin/env bash
# Installs the peers of the judge into the folder given: packages of Python and of Node.
set -euo pipefail
ours=$(cd "$(dirname "$0")" && pwd)
folder=$1
stamp=$(cat "$ours/requirements.txt" "$ours/package.json" | cksum)
[ "$(cat "$folder/stamp" 2> /dev/null)" != "$stamp" ] || exit 0
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check -r "$ours/requirements.txt"
cp "$ours/package.json" "$folder/package.json"
npm install --prefix "$folder" --no-audit --no-fund --loglevel=error > /dev/null
echo "$stamp" > "$folder/stamp"
