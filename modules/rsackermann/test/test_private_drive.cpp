// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"

#include "../src/camera/lens.cpp"
#include "../src/camera/rays.cpp"
#include "../src/drive/drive_fit.cpp"
#include "../src/drive/drive_state.cpp"
#include "../src/drive/flow_residual.cpp"
#include "../src/drive/point_tracker.cpp"
#include "../src/drive/relief_fit.cpp"
#include "../src/relief.cpp"
