// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// The test framework of OpenCV 4 includes this header of its old C interface, which OpenCV 5 doesn't have, but needs
// nothing of it.
