#!/usr/bin/env python3
"""Checks what perf/experiments/reconstruct.sh makes of COLMAP's models, on one that is made of known errors.

usage: check_reconstruction.py ROOT
"""

import json
import os
import subprocess
import sys
import tempfile

import cv2
import numpy

tools = os.path.join(sys.argv[1], 'perf', 'experiments', 'reconstruction')
FRAMES = 30


def turn(axis, degrees):
    """Rotation about a coordinate axis."""
    matrix = numpy.eye(3)
    i, j = [k for k in range(3) if k != axis]
    c, s = numpy.cos(numpy.radians(degrees)), numpy.sin(numpy.radians(degrees))
    matrix[[i, i, j, j], [i, j, i, j]] = c, -s, s, c
    return matrix


def quaternion(matrix):
    """w, x, y, z of a rotation by less than half a turn."""
    w = numpy.sqrt(1 + numpy.trace(matrix)) / 2
    return [w] + [(matrix[(k + 2) % 3, (k + 1) % 3] - matrix[(k + 1) % 3, (k + 2) % 3]) / (4 * w) for k in range(3)]


def run(tool, *arguments):
    return subprocess.run([sys.executable, '-B', os.path.join(tools, tool), *arguments], check=True,
                          stdout=subprocess.PIPE, universal_newlines=True).stdout


def write_model(folder, poses):
    """As COLMAP does: a line for each image and one for its points, and a line for each point."""
    os.makedirs(folder)
    with open(os.path.join(folder, 'images.txt'), 'w', encoding='utf-8') as file:
        file.write('# Image list\n')
        for name, (rotation, centre) in poses.items():
            values = quaternion(rotation) + list(-rotation @ centre)
            file.write('1 %s 1 %s\n1.5 2.5 -1 3.5 4.5 7\n' % (' '.join('%r' % float(value) for value in values), name))
    with open(os.path.join(folder, 'points3D.txt'), 'w', encoding='utf-8') as file:
        file.write('# 3D point list\n1 0 0 5 9 9 9 0.5 1 0 2 0\n2 0 0 5 9 9 9 1.0 1 1 2 1 3 0 4 1 5 0 6 1\n')


def write_wall(folder):
    """A drive along a wall at 10 m, which the camera faces, and a model of it. Returns the median of the errors that poses
    of frames make, in cm."""
    fx, cx, cy, line_delay, speed, distance = 100, 49.5, 29.5, 5e-4, 12, 10
    os.makedirs(os.path.join(folder, 'depth'))
    points = numpy.random.RandomState(1).uniform((0, -2.5), (4, 2.5), (40, 2))
    rows = fx * points[:, 1] / distance + cy
    frames, images = [], []
    for i in range(12):
        name = '%06d.png' % i
        view = numpy.eye(4)
        view[0, 3] = -speed * i / 30
        frames.append({'file': name, 'viewmat': view.tolist(), 'line_delay_s': line_delay, 'reference': cy, 'fx': fx,
                       'fy': fx, 'cx': cx, 'cy': cy})
        cv2.imwrite(os.path.join(folder, 'depth', name), numpy.full((60, 100), 256 * distance, numpy.uint16))
        columns = fx * (points[:, 0] - speed * (i / 30 + (rows - cy) * line_delay)) / distance + cx
        images.append('%d 1 0 0 0 0 0 0 1 %s\n' % (i + 1, name))
        images.append(' '.join('%r %r %d' % (x + 0.5, y + 0.5, point if 0 <= x <= 99 else -1)
                               for point, (x, y) in enumerate(zip(columns.tolist(), rows.tolist()))) + '\n')
    ends = [numpy.eye(4), numpy.eye(4)]
    for end, row in zip(ends, (0, 59)):
        end[0, 3] = -speed * (row - cy) * line_delay
    poses = {'start_line': 0, 'end_line': 59, 'frames': [
        {'file': frame['file'], 'viewmat_start': ends[0].tolist(), 'viewmat_end': ends[1].tolist()} for frame in frames]}
    for name, lines in (('truth.jsonl', [json.dumps(frame) + '\n' for frame in frames]), ('images.txt', images),
                        ('rows.json', [json.dumps(poses)])):
        with open(os.path.join(folder, name), 'w', encoding='utf-8') as file:
            file.writelines(lines)
    return 100 * numpy.median(speed * abs(rows - cy) * line_delay)


def close(text, *expected):
    return numpy.allclose([float(word) for word in text.split()], expected, rtol=0.02, atol=0.002)


def main(folder):
    drive = os.path.join(folder, 'truth.jsonl')
    true = {}
    with open(drive, 'w', encoding='utf-8') as file:
        for i in range(FRAMES):
            name, rotation = '%06d.png' % i, turn(1, 2.0 * i) @ turn(0, 3.0)
            centre = numpy.array([9 * numpy.sin(0.3 * i), 8 * numpy.cos(0.5 * i), 0.7 * i])
            true[name] = rotation, centre
            view = numpy.eye(4)
            view[:3, :3], view[:3, 3] = rotation, -rotation @ centre
            file.write(json.dumps({'file': name, 'viewmat': view.tolist(), 'time_s': i / 30, 'speed_km_h': 39.6,
                                   'yaw_rate_deg_s': -0.4}) + '\n')
    way = sum(numpy.linalg.norm(true['%06d.png' % i][1] - true['%06d.png' % (i - 1)][1]) for i in range(1, FRAMES))

    # The same in another frame and unit, without every third image; and errors to and fro that no similarity follows.
    other, shift, unit = turn(2, 40.0) @ turn(0, -20.0), numpy.array([1.0, -2.0, 3.0]), 0.3
    exact, wrong = {}, {}
    for i, (name, (rotation, centre)) in enumerate(true.items()):
        if i % 3:
            exact[name] = rotation @ other.T, unit * other @ centre + shift
            error = numpy.array([0.05 * (-1) ** i, 0, 0])
            wrong[name] = turn(0, 0.8) @ rotation @ other.T, unit * other @ (centre + error) + shift
    few = dict(list(wrong.items())[:5])
    models = [os.path.join(folder, name) for name in ('exact', 'wrong', 'few')]
    for model, poses in zip(models, (exact, wrong, few)):
        write_model(model, poses)
    error = 5 / way  # percent of the way: 5 cm
    checks = [
        close(run('compare_poses.py', drive, models[0]), 20, 0.875, 0, 0, 0),
        close(run('compare_poses.py', drive, models[1]), 20, 0.875, 5, error, 0.8),
        close(run('compare_poses.py', drive, models[2], models[1]), 20, 0.875, 5, error, 0.8),
        run('write_log.py', drive, 'speed_kmh', 'yaw_rate_deg_s').splitlines()[:3] ==
        ['file,time_s,speed_kmh,yaw_rate_deg_s', '000000.png,0.000000000,40,0', '000001.png,0.033333333,40,0']]

    wall = os.path.join(folder, 'wall')
    error = write_wall(wall)
    checks.append(close(run('compare_points.py', wall, wall, os.path.join(wall, 'rows.json')), 40, error, 0, 0))

    with open(os.path.join(folder, 'cameras.txt'), 'w', encoding='utf-8') as file:
        for view in ('side', 'forward'):
            for kind, centres in (('frames', 20), ('corrected', 5), ('yaw_rate_depth', 4), ('global', 2)):
                file.writelines('%s %s %d 58 0.4 %g 0.05 0.2\n' % (view, kind, i, centres + i) for i in (1, 2, 3))
    with open(os.path.join(folder, 'points.txt'), 'w', encoding='utf-8') as file:
        for view in ('side', 'forward'):
            for kind in ('corrected', 'yaw_rate_depth'):
                file.writelines('%s %s %d 999 %g 1.2 0.5\n' % (view, kind, i, 6 + i) for i in (1, 2, 3))
    table = run('table.py', folder, '60')
    checks.append('| to the side | corrected, speed of a log | 58 of 60 | 0.40 | 7.00 | 0.050 | 0.32 | 1.75 | 0.20 |'
                  in table)
    checks.append('| ahead | speed and yaw rate | 999 | 8.0 | 1.2 | 0.5 |' in table)
    checks.append(len(table.splitlines()) == 10 + 1 + 6)
    with open(os.path.join(folder, 'forward'), encoding='utf-8') as file:
        checks.append(file.read().splitlines()[3] == '1 6 "corrected"')
    for number, passed in enumerate(checks):
        if not passed:
            print('check %d has failed' % (number + 1))
    return 0 if all(checks) else 1


if __name__ == '__main__':
    with tempfile.TemporaryDirectory() as temporary:
        sys.exit(main(temporary))
