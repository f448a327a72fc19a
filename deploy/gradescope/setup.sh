#!/bin/bash
# Run once by Gradescope, as root, when it builds the image of the autograder (Ubuntu 22.04): installs the software
# driver, and ends the build where this machine cannot grade.
set -eu
source=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

export DEBIAN_FRONTEND=noninteractive
apt-get update --quiet --quiet
apt-get install --yes --quiet --quiet --no-install-recommends mesa-vulkan-drivers libvulkan1 libstdc++6
apt-get clean
rm -rf /var/lib/apt/lists/*

chmod +x "$source/ggrade" "$source/run_autograder"
"$source/ggrade" doctor
