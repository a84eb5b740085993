#!/usr/bin/env python3
"""Makes the tables of reconstruct.sh of its measurements, and the data of its plot.

Reads lines "view kind drive" followed by those of compare_poses.py in FOLDER/cameras.txt, and of compare_points.py in
FOLDER/points.txt. Prints medians over the drives in Markdown, and writes for each kind its number, the errors of the
centres of the drives in cm and its name to FOLDER/VIEW.

usage: table.py FOLDER IMAGES
"""

import os
import statistics
import sys

KINDS = {
    'frames': 'raw',
    'corrected': 'corrected, speed of a log',
    'yaw_rate_depth': 'corrected with depth, speed and yaw rate of a log',
    'global': 'global shutter',
}
ROWS = {'corrected': 'speed', 'yaw_rate_depth': 'speed and yaw rate'}
VIEWS = {'side': 'to the side', 'forward': 'ahead'}


def read(path):
    """Measurements of the drives by view and kind."""
    rows = {}
    with open(path, encoding='utf-8') as file:
        for line in file:
            view, kind, _, *values = line.split()
            rows.setdefault((view, kind), []).append([float(value) for value in values])
    return rows


def medians(rows):
    return [statistics.median(column) for column in zip(*rows)]


def print_cameras(folder, images):
    rows = read(os.path.join(folder, 'cameras.txt'))
    print('| camera looks | images | registered | reprojection error, px | centres, cm | of the way, % | over raw | '
          'over global shutter | angles, deg |')
    print('|---|---|---|---|---|---|---|---|---|')
    for view, direction in VIEWS.items():
        raw, best = (statistics.median(row[2] for row in rows[view, kind]) for kind in ('frames', 'global'))
        with open(os.path.join(folder, view), 'w', encoding='utf-8') as file:
            for number, (kind, title) in enumerate(KINDS.items()):
                drives = rows[view, kind]
                registered, pixels, centres, share, angles = medians(drives)
                print('| %s | %s | %d of %s | %.2f | %.2f | %.3f | %.2f | %.2f | %.2f |' %
                      (direction, title, registered, images, pixels, centres, share, centres / raw, centres / best,
                       angles))
                file.writelines('%d %g "%s"\n' % (number, drive[2], title.split(',')[0].replace(' with', '\\nwith')) for drive in drives)


def print_points(folder):
    rows = read(os.path.join(folder, 'points.txt'))
    print('\n| camera looks | log | points | poses of frames, cm | of rows, cm | true poses of rows, cm |')
    print('|---|---|---|---|---|---|')
    for view, direction in VIEWS.items():
        for kind, log in ROWS.items():
            print('| %s | %s | %d | %.1f | %.1f | %.1f |' % (direction, log, *medians(rows[view, kind])))


def main(folder, images):
    print_cameras(folder, images)
    print_points(folder)


if __name__ == '__main__':
    main(*sys.argv[1:])
