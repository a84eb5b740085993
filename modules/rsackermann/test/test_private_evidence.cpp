// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"

#include "../src/estimator/displacement_field.cpp"
#include "../src/estimator/motion_mixture.cpp"
#include "../src/estimator/refinement.cpp"
#include "../src/estimator/road_contact.cpp"
#include "../src/estimator/slant_noise.cpp"
#include "../src/estimator/residuals/prior_residuals.cpp"
#include "../src/estimator/residuals/usual_drive.cpp"
