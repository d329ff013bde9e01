#!/bin/sh
# Set up, build ents-lab, solve every scene of gallery.json and hold it against its exact answer.
set -eu
cd "$(dirname "$0")/.."

case ${1-} in -h | --help) exec /usr/bin/python3 examples/gallery.py --help ;; esac
sh examples/setup.sh --target ents-lab
exec /usr/bin/python3 examples/gallery.py "$@"
