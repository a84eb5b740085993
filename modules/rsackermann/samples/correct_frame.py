#!/usr/bin/env python
# This file is part of OpenCV project.
# It is subject to the license terms in the LICENSE file found in the top-level directory
# of this distribution and at http://opencv.org/license.html.
"""Undoes the rolling shutter of one image of a car's camera.

usage: correct_frame.py IMAGE CORRECTED [LINE_DELAY [FOCAL]]
       LINE_DELAY seconds between two rows, FOCAL pixels (0: 0.9 times the longer side)
"""

import sys

import cv2 as cv

try:
    from cv2 import rsackermann
except ImportError:  # the package beside an installed cv2
    import rsackermann


## [correct]
def correct_frame(image, line_delay, focal=0):
    camera = rsackermann.RollingShutterCamera.fromFocal(image.shape[1::-1], focal)
    camera.lineDelay = line_delay
    corrector = rsackermann.RollingShutterCorrector.create(camera)
    motion, corrected, mask = corrector.correct(image)
    known, yaw_rate = motion.yawRate(camera)  # radians per second
    return motion, corrected, mask
## [correct]


def main(arguments):
    if len(arguments) not in (2, 3, 4):
        print(__doc__)
        return 2
    image = cv.imread(arguments[0])
    if image is None:
        print(arguments[0] + " can't be read")
        return 1
    motion, corrected, _ = correct_frame(image, *[float(a) for a in arguments[2:]] or [0.0])
    cv.imwrite(arguments[1], corrected)
    print('status %d, %d of %d candidates agree' % (motion.status, motion.inliers, motion.candidates))
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
