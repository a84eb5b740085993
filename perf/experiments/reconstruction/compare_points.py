#!/usr/bin/env python3
"""Triangulates points of raw frames, with one pose for each frame and with one for each row, and compares with the truth.

The tracks are those of COLMAP's model of the raw frames. The poses of the frames are the true ones, those of rows come
from the file of rsackermann_export --row_poses besides. The true places come from the depth of the frames and the true
poses of rows. Prints a line: points, and their median errors in cm with the poses of frames, with the estimated poses of
rows and with the true ones.

usage: compare_points.py DRIVE RAW_MODEL ROW_POSES
"""

import json
import os
import sys

import cv2
import numpy

from compare_poses import centres_of, lines_of, read_truth

UNITS_PER_METRE = 256  # of the depth
LEAST_RAYS, LEAST_ANGLE = 3, 5  # of a point; degrees


def read_camera(path):
    with open(path, encoding='utf-8') as file:
        return json.loads(file.readline())


def read_tracks(model):
    """For each point its observations: name of the image, pixel with the first pixel's centre at (0, 0)."""
    tracks = {}
    lines = lines_of(os.path.join(model, 'images.txt'))
    for image, points in zip(lines[::2], lines[1::2]):
        name, words = image.split()[9], points.split()
        for x, y, point in zip(words[::3], words[1::3], words[2::3]):
            if point != '-1':
                tracks.setdefault(point, []).append((name, float(x) - 0.5, float(y) - 0.5))
    return [track for track in tracks.values() if len(track) >= LEAST_RAYS]


def between(first, second, share):
    """The pose at a share of the way from one to another one that is turned by a small angle against it."""
    turn, _ = cv2.Rodrigues(second[:3, :3] @ first[:3, :3].T)
    centres = centres_of([first, second])
    pose = numpy.eye(4)
    pose[:3, :3] = cv2.Rodrigues(share * turn)[0] @ first[:3, :3]
    pose[:3, 3] = -pose[:3, :3] @ (centres[0] + share * (centres[1] - centres[0]))
    return pose


class TrueRows:
    """Poses of rows by those of the frames, which are near enough in time."""

    def __init__(self, truth, camera, frames_per_second=30):
        self.names, self.views = list(truth), list(truth.values())
        self.frames_per_row = camera['line_delay_s'] * frames_per_second
        self.reference = camera['reference']

    def __call__(self, name, row):
        at = self.names.index(name) + (row - self.reference) * self.frames_per_row
        first = min(max(int(at), 0), len(self.views) - 2)
        return between(self.views[first], self.views[first + 1], at - first)


class EstimatedRows:
    """Poses of rows by those of frames and by what rsackermann_export says of the rows, in metres."""

    def __init__(self, views, path):
        with open(path, encoding='utf-8') as file:
            poses = json.load(file)
        self.views, self.start, self.end = views, poses['start_line'], poses['end_line']
        self.frames = dict((frame['file'], frame) for frame in poses['frames'])

    def __call__(self, name, row):
        ends = [numpy.array(self.frames[name][key]) for key in ('viewmat_start', 'viewmat_end')]
        return between(*ends, (row - self.start) / (self.end - self.start)) @ self.views[name]


def ray_of(camera, pose, x, y):
    """Centre of the camera, and the ray of a pixel whose length along the optical axis is 1."""
    ray = pose[:3, :3].T @ [(x - camera['cx']) / camera['fx'], (y - camera['cy']) / camera['fy'], 1]
    return -pose[:3, :3].T @ pose[:3, 3], ray


def triangulate(rays):
    """The place with the least squares of the distances to the rays; None if they are too close to each other."""
    centres = numpy.array([centre for centre, _ in rays])
    directions = numpy.array([ray / numpy.linalg.norm(ray) for _, ray in rays])
    if (directions @ directions.T).min() > numpy.cos(numpy.radians(LEAST_ANGLE)):
        return None
    across = numpy.eye(3) - directions[:, :, None] * directions[:, None, :]
    return numpy.linalg.solve(across.sum(axis=0), (across @ centres[:, :, None]).sum(axis=0))[:, 0]


def true_place(camera, rows, depths, name, x, y):
    """By the depth of a frame; None next to an edge of the depth and in the sky."""
    column, row = int(round(x)), int(round(y))
    around = depths[name][max(row - 1, 0):row + 2, max(column - 1, 0):column + 2] / UNITS_PER_METRE
    if not around.size or around.min() == 0 or around.max() > 1.03 * around.min():
        return None
    centre, ray = ray_of(camera, rows(name, y), x, y)
    return centre + ray * numpy.median(around)


def main(drive, model, row_poses):
    truth_path = os.path.join(drive, 'truth.jsonl')
    camera, truth = read_camera(truth_path), read_truth(truth_path)
    poses = [lambda name, row: truth[name], EstimatedRows(truth, row_poses), TrueRows(truth, camera)]
    depths = dict((name, cv2.imread(os.path.join(drive, 'depth', name), cv2.IMREAD_UNCHANGED)) for name in truth)
    errors = []
    for track in read_tracks(model):
        place = true_place(camera, poses[-1], depths, *track[len(track) // 2])
        if place is None:
            continue
        found = [triangulate([ray_of(camera, pose_of(name, y), x, y) for name, x, y in track]) for pose_of in poses]
        if all(point is not None for point in found):
            errors.append([numpy.linalg.norm(point - place) for point in found])
    print('%d %.2f %.2f %.2f' % (len(errors), *(100 * numpy.median(errors, axis=0))))


if __name__ == '__main__':
    main(*sys.argv[1:])
