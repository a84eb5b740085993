#!/usr/bin/env python
# This file is part of OpenCV project.
# It is subject to the license terms in the LICENSE file found in the top-level directory
# of this distribution and at http://opencv.org/license.html.
"""Undoes the rolling shutter of images with the depth that a network sees in them: an ONNX file, run by OpenCV."""

import argparse
import os
import sys

import cv2 as cv
import numpy as np

try:
    from cv2 import rsackermann
except ImportError:  # the package beside an installed cv2
    import rsackermann

# Input size, and what is subtracted from the values of red, green and blue, from 0 to 255, before they are divided. The
# exporter of MiDaS has the network normalise its input.
NETWORKS = {'midas_small': (256, [0, 0, 0], [255, 255, 255]),
            'midas': (384, [0, 0, 0], [255, 255, 255]),
            'dpt': (384, [127.5, 127.5, 127.5], [127.5, 127.5, 127.5]),
            'depth_anything': (518, [123.675, 116.28, 103.53], [58.395, 57.12, 57.375])}


class Failure(Exception):
    """A file can't be read, written or understood."""


ERRORS = Failure, OSError, cv.error, getattr(rsackermann, 'error', cv.error)


def read_network(path):
    with open(path, 'rb') as file:
        content = np.frombuffer(file.read(), np.uint8)
    try:
        network = cv.dnn.readNetFromONNX(content)
    except cv.error as error:
        raise Failure('%s: OpenCV %s can\'t read it as a network in ONNX: %s' %
                      (path, cv.__version__, error.err.strip())) from error
    outputs = network.getUnconnectedOutLayersNames()
    if len(outputs) != 1:
        raise Failure('%s: the network has %d outputs; one is expected' % (path, len(outputs)))
    return network


## [depth]
def network_output(network, image, size, mean, scale, bgr=False):
    """What the network says of a BGR image, scaled to its size; mean and scale are those of red, green and blue."""
    values = cv.resize(image, size, interpolation=cv.INTER_AREA)
    values = (values - np.float32(mean[::-1])) * np.float32(scale[::-1])
    network.setInput(cv.dnn.blobFromImage(values, swapRB=not bgr))
    try:
        output = network.forward()
    except cv.error as error:
        raise Failure('the network doesn\'t run on one input of %d x %d pixels: %s' %
                      (*size, error.err.strip())) from error
    if min(output.shape[-2:]) < 2 or output.size != np.prod(output.shape[-2:]):
        raise Failure('the output of shape %s isn\'t a depth; one number for each pixel is expected' %
                      (output.shape,))
    return cv.resize(output.reshape(output.shape[-2:]), image.shape[1::-1])
## [depth]


## [correct]
def correct_with_depth(image, depth, camera, prior, params):
    """The motion, the corrected image and the depth that was used, which is empty if it contradicts the image."""
    corrector = rsackermann.RollingShutterCorrector.create(camera, params)
    corrector.setPrior(prior)
    motion, corrected, _ = corrector.correct(image, depth=depth)
    return motion, corrected, corrector.getUsedDepth()
## [correct]


def write_image(path, image):
    """A file that appears complete or not at all."""
    extension = os.path.splitext(path)[1]
    if not extension or not cv.haveImageWriter(path):
        raise Failure(path + ' has the extension of no image format that can be written')
    _, content = cv.imencode(extension, image)
    part = path + '.part'
    try:
        with open(part, 'wb') as file:
            file.write(content)
        os.replace(part, path)
    except OSError:
        if os.path.exists(part):
            os.remove(part)
        raise


def correct_file(path, output, network, options):
    if os.path.exists(output):
        raise Failure(output + ' exists')
    image = cv.imread(path, cv.IMREAD_COLOR)
    if image is None:
        raise Failure('the image can\'t be read')
    try:
        depth = network_output(network, image, tuple(options.input_size), options.mean, options.scale, options.bgr)
    except Failure as error:
        raise Failure('%s: %s' % (options.model, error)) from error

    camera = rsackermann.RollingShutterCamera.fromFocal(image.shape[1::-1], options.focal)
    camera.lineDelay = options.line_delay
    prior = rsackermann.MotionPrior()
    if options.speed is not None:
        prior.speed, prior.speedSigma = options.speed / 3.6, 2 / 3.6
    if options.yaw_rate is not None:
        prior.yawRate, prior.yawRateSigma = np.radians(options.yaw_rate), np.radians(1)
    estimation = rsackermann.AckermannEstimator.Params()
    estimation.wallDistance = options.wall
    params = rsackermann.RollingShutterCorrector.Params()
    params.setEstimatorParams(estimation)
    kind = rsackermann.DEPTH_METRIC if options.depth_kind == 'metric' else rsackermann.DEPTH_RELATIVE
    motion, corrected, used = correct_with_depth(
        image, rsackermann.DepthMap(depth, rsackermann.DEPTH_RAW, 1, kind), camera, prior, params)
    write_image(output, corrected)
    print('%s: status %d; output %g to %g; depth %s' %
          (path, motion.status, depth.min(), depth.max(),
           'not used' if used.empty() else 'used' if kind == rsackermann.DEPTH_METRIC else
           'used: inverse depth %g * output %+g' % (used.scale, used.shift)))


def read_options(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('images', nargs='+')
    parser.add_argument('--model', required=True, help='ONNX file')
    parser.add_argument('--output', required=True, help='corrected image; a folder for several images. Existing files stay')
    parser.add_argument('--network', choices=sorted(NETWORKS), default='midas_small',
                        help='whose input it has, the defaults of the next three options')
    parser.add_argument('--input_size', nargs=2, type=int, metavar=('WIDTH', 'HEIGHT'))
    parser.add_argument('--mean', nargs=3, type=float, metavar=('R', 'G', 'B'), help='subtracted from 0 to 255')
    parser.add_argument('--scale', nargs=3, type=float, metavar=('R', 'G', 'B'), help='multiplies the difference')
    parser.add_argument('--bgr', action='store_true', help='the network takes blue first')
    parser.add_argument('--depth_kind', choices=('relative', 'metric'), default='relative')
    parser.add_argument('--focal', type=float, default=0, help='pixels; default: 0.9 times the longer side')
    parser.add_argument('--line_delay', type=float, default=0, help='seconds between two rows')
    parser.add_argument('--speed', type=float, help='km/h, known to 2 km/h')
    parser.add_argument('--yaw_rate', type=float, help='deg/s, known to 1 deg/s')
    parser.add_argument('--wall', type=float, default=0, help='metres to the left (or only) wall')
    options = parser.parse_args(arguments)
    size, mean, deviations = NETWORKS[options.network]
    options.input_size = options.input_size or [size, size]
    options.mean = options.mean or mean
    options.scale = options.scale or [1 / deviation for deviation in deviations]
    return options


def main(arguments):
    options = read_options(arguments)
    try:
        network = read_network(options.model)
        is_folder = len(options.images) > 1 or os.path.isdir(options.output) or options.output.endswith('/')
        if is_folder:
            os.makedirs(options.output, exist_ok=True)
    except ERRORS as error:
        print(error, file=sys.stderr)
        return 1
    failures = 0
    for path in options.images:
        try:
            correct_file(path, os.path.join(options.output, os.path.basename(path)) if is_folder else options.output,
                         network, options)
        except ERRORS as error:
            failures += 1
            print('%s: %s' % (path, error), file=sys.stderr)
    return 1 if failures else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
