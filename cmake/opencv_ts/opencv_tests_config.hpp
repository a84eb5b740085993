// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// opencv_ts includes this generated header for the place of OpenCV's test data, which these tests don't use.
