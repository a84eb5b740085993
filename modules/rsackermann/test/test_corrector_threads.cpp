// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_threads.hpp"
#include "opencv2/rsackermann/corrector.hpp"

namespace opencv_test { namespace {

TEST(RSAckermann_Threads, one_corrector_each)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    Mat expected[THREADS], corrected[THREADS];
    for (int i = 0; i < THREADS; i++)
        RollingShutterCorrector::create(camera)->correct(streetImage(i), expected[i]);
    inThreads([&](int i) {
        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
        for (int frame = 0; frame < 3; frame++)
            corrector->correct(streetImage(i), corrected[i]);
    });
    for (int i = 0; i < THREADS; i++)
        EXPECT_EQ(0, cvtest::norm(expected[i], corrected[i], NORM_INF));
}

}} // namespace
