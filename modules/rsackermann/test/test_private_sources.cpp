// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"

// The library doesn't export its internals: the test program has the estimator a second time, for tests of its decisions.

#include "../src/camera/lens.cpp"
#include "../src/camera/rays.cpp"
#include "../src/drive/drive_fit.cpp"
#include "../src/drive/drive_state.cpp"
#include "../src/drive/flow_residual.cpp"
#include "../src/drive/point_tracker.cpp"
#include "../src/estimator/account.cpp"
#include "../src/estimator/upright_segment.cpp"
#include "../src/estimator/consensus.cpp"
#include "../src/estimator/displacement_field.cpp"
#include "../src/estimator/fit.cpp"
#include "../src/estimator/motion_mixture.cpp"
#include "../src/estimator/residuals/prior_residuals.cpp"
#include "../src/estimator/refinement.cpp"
#include "../src/estimator/selection.cpp"
#include "../src/estimator/significance.cpp"
#include "../src/estimator/slant_noise.cpp"
#include "../src/estimator/street_direction.cpp"
#include "../src/estimator/uncertainty.cpp"
#include "../src/estimator/residuals/usual_drive.cpp"
