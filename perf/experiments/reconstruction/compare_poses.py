#!/usr/bin/env python3
"""Compares the cameras that COLMAP has reconstructed with the true ones.

Reads truth.jsonl of a drive of rsackermann_simulate and images.txt and points3D.txt of the models of COLMAP, of which
that with most images counts. It is aligned by the similarity that fits the centres of all registered images best. Prints
a line: registered images, mean reprojection error in px, root mean square of the errors of the centres in cm, the same in
percent of the length of the way, and the median error of the angles in degrees.

usage: compare_poses.py TRUTH MODEL...
"""

import json
import os
import sys

import numpy


def read_truth(path):
    """World-to-camera matrices of the drive's frames by the names of their files, in their order."""
    with open(path, encoding='utf-8') as file:
        frames = [json.loads(line) for line in file]
    return dict((frame['file'], numpy.array(frame['viewmat'])) for frame in frames)


def lines_of(path):
    with open(path, encoding='utf-8') as file:
        return [line for line in file if not line.startswith('#')]


def rotation(w, x, y, z):
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def read_images(path):
    """World-to-camera matrices by the names of the images."""
    views = {}
    for line in lines_of(path)[::2]:  # every second line has an image's points
        words = line.split()
        view = numpy.eye(4)
        view[:3, :3] = rotation(*(float(word) for word in words[1:5]))
        view[:3, 3] = [float(word) for word in words[5:8]]
        views[words[9]] = view
    return views


def reprojection_error(path):
    """Mean over the observations of all points."""
    errors, counts = [], []
    for line in lines_of(path):
        words = line.split()
        errors.append(float(words[7]))
        counts.append(len(words[8:]) // 2)
    return numpy.average(errors, weights=counts)


def centres_of(views):
    return numpy.array([-view[:3, :3].T @ view[:3, 3] for view in views])


def fit_similarity(source, target):
    """Scale, rotation and shift that turn points into others with the least squares (Umeyama 1991)."""
    means = source.mean(axis=0), target.mean(axis=0)
    source, target = source - means[0], target - means[1]
    u, values, vt = numpy.linalg.svd(target.T @ source)
    signs = numpy.array([1, 1, numpy.sign(numpy.linalg.det(u @ vt))])
    turn = (u * signs) @ vt
    scale = (values * signs).sum() / (source * source).sum()
    return scale, turn, means[1] - scale * turn @ means[0]


def degrees(turn):
    """Angle of a rotation."""
    sine = numpy.linalg.norm(turn - turn.T) / numpy.sqrt(8)
    return numpy.degrees(numpy.arctan2(sine, (numpy.trace(turn) - 1) / 2))


def main(truth_path, *models):
    truth = read_truth(truth_path)
    found, model = max(((read_images(os.path.join(model, 'images.txt')), model) for model in models),
                       key=lambda candidate: len(candidate[0]))
    names = [name for name in truth if name in found]
    true_views, views = [truth[name] for name in names], [found[name] for name in names]
    true_centres, centres = centres_of(true_views), centres_of(views)
    scale, turn, shift = fit_similarity(centres, true_centres)
    errors = numpy.linalg.norm(scale * centres @ turn.T + shift - true_centres, axis=1)
    rms = numpy.sqrt((errors * errors).mean())
    way = numpy.linalg.norm(numpy.diff(centres_of(truth.values()), axis=0), axis=1).sum()
    angles = [degrees(view[:3, :3] @ turn.T @ true_view[:3, :3].T) for view, true_view in zip(views, true_views)]
    print('%d %.3f %.2f %.3f %.3f' % (len(names), reprojection_error(os.path.join(model, 'points3D.txt')), 100 * rms,
                                      100 * rms / way, numpy.median(angles)))


if __name__ == '__main__':
    main(*sys.argv[1:])
