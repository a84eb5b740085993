#!/bin/bash
# Follows the README in a bare Debian 12: clone, demo, correction of an image of one's own. Prints how long each step
# took, and all of them. Needs root.
# usage: test_from_clone.sh

. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/chroot.sh"
logs=$cache/logs-clone
bare=$cache/debian-bookworm
system=$cache/clone-bookworm

make_chroot "$bare" bookworm "$logs/debootstrap.log"
rm -rf --one-file-system "$system"
trap 'rm -rf --one-file-system "$system"' EXIT
cp -a --reflink=auto "$bare" "$system"
logged "$logs/git.log" in_chroot "$system" sh -ec 'apt-get update; apt-get install -y git'

# usage: timed TITLE COMMAND    in the clone
timed()
{
    TIMEFORMAT="$1: %0R s, processor %0U s"
    time logged "$logs/$1.log" in_chroot "$system" sh -ec "cd /root; [ ! -d rsackermann ] || cd rsackermann; $2"
}

time {
    timed clone 'git clone -q /src rsackermann'
    timed demo samples/run_demo.sh
    timed image 'cp build/demo/rolling.png street.jpg
        build/samples/rsackermann_correct street.jpg --output=corrected.jpg --report=-
        test -s corrected.jpg'
    TIMEFORMAT='all: %0R s, processor %0U s'
}
