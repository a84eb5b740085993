// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_TEST_CORRECTOR_COMMON_HPP
#define OPENCV_RSACKERMANN_TEST_CORRECTOR_COMMON_HPP

#include "test_common.hpp"
#include "opencv2/rsackermann/corrector.hpp"

namespace opencv_test {

//! Parameters none of which has its default.
inline RollingShutterCorrector::Params exampleCorrectorParams()
{
    RollingShutterCorrector::Params p;
    p.estimator = exampleEstimatorParams();
    p.warp = exampleWarpParams();
    p.interpolation = INTER_CUBIC;
    p.sequence = true;
    p.trackPoints = false;
    p.frameInterval = 0.04;
    p.gyroDelaySigma = 0.001;
    p.gyroAxesSigma = 0.002;
    p.gyroBiasSigma = 0.003;
    p.gyroScaleSigma = 0.004;
    return p;
}

inline void expectSame(const RollingShutterCorrector::Params& a, const RollingShutterCorrector::Params& b)
{
    expectSame(a.estimator, b.estimator);
    expectSame(a.warp, b.warp);
    EXPECT_EQ(a.interpolation, b.interpolation);
    EXPECT_EQ(a.sequence, b.sequence);
    EXPECT_EQ(a.trackPoints, b.trackPoints);
    EXPECT_EQ(a.frameInterval, b.frameInterval);
    EXPECT_EQ(a.gyroDelaySigma, b.gyroDelaySigma);
    EXPECT_EQ(a.gyroAxesSigma, b.gyroAxesSigma);
    EXPECT_EQ(a.gyroBiasSigma, b.gyroBiasSigma);
    EXPECT_EQ(a.gyroScaleSigma, b.gyroScaleSigma);
}

} // namespace opencv_test

#endif // OPENCV_RSACKERMANN_TEST_CORRECTOR_COMMON_HPP
