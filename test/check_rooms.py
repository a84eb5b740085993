#!/usr/bin/env python3
"""Checks that includes of the module's sources go one way: from a room to those below it.

usage: check_rooms.py ROOT
"""
import os
import re
import sys

# Each room may include those to the right of it.
ORDER = ['calibration', 'sequence', 'single', 'factors', 'features', 'motion', 'scene', 'camera']
# Beside them: rooms that others use, and what these may include themselves.
BESIDE = {'solvers': ['motion', 'scene', 'camera'], 'warp': ['motion', 'scene', 'camera'], 'optim': []}
# Rooms of the classes that the library consists of; other files beside the rooms stand below all of them.
TOP = ['corrector.cpp', 'draw.cpp']


def allowed(room):
    if room in TOP:
        return ORDER + list(BESIDE)
    if room in BESIDE:
        return BESIDE[room]
    if room in ORDER:
        return ORDER[ORDER.index(room) + 1:] + ['optim']
    return []


def main(root):
    sources = os.path.join(root, 'modules', 'rsackermann', 'src')
    problems, count = [], 0
    for folder, _, names in os.walk(sources):
        for name in names:
            path = os.path.relpath(os.path.join(folder, name), sources)
            room = path.split(os.sep)[0]
            with open(os.path.join(folder, name), encoding='utf-8') as f:
                text = f.read()
            for included in re.findall(r'^#include "([^"]+)"', text, re.M):
                target = os.path.relpath(os.path.join(folder, included), sources)
                if not os.path.isfile(os.path.join(sources, target)):
                    target = included  # as the kernels, which are included from src/
                if not os.path.isfile(os.path.join(sources, target)):
                    continue  # public, or made by the build
                count += 1
                other = target.split(os.sep)[0]
                is_room = other in ORDER or other in BESIDE
                if other != room and (is_room or other in TOP) and other not in allowed(room):
                    problems.append('%s includes %s' % (path, target))
    rooms = {f for f in os.listdir(sources) if os.path.isdir(os.path.join(sources, f))} - {'opencl'}
    problems += ['%s isn\'t in the order of rooms' % room for room in rooms - set(ORDER) - set(BESIDE)]
    print('\n'.join(problems) or '%d includes go the right way' % count)
    return bool(problems or not count)


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
