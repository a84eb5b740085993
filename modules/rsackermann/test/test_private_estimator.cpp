// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"

// The library doesn't export its internals: the test program has a part of the sources a second time, for direct tests;
// see the other test_private_*.cpp, too.

#include "../src/estimator/account.cpp"
#include "../src/estimator/consensus.cpp"
#include "../src/estimator/fit.cpp"
#include "../src/estimator/selection.cpp"
#include "../src/estimator/significance.cpp"
#include "../src/estimator/street_direction.cpp"
#include "../src/estimator/uncertainty.cpp"
#include "../src/estimator/upright_segment.cpp"
