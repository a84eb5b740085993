// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_corrector_common.hpp"
#include "test_storage.hpp"

namespace opencv_test { namespace {

TEST(RSAckermann_Storage, corrector_params)
{
    checkStorage(exampleCorrectorParams(), "frame_interval", &RollingShutterCorrector::Params::frameInterval);
}

TEST(RSAckermann_Storage, fields_of_fields)
{
    RollingShutterCorrector::Params params;
    params.setEstimatorParams(exampleEstimatorParams());
    params.setWarpParams(exampleWarpParams());
    expectSame(exampleEstimatorParams(), params.estimator);
    expectSame(exampleEstimatorParams(), params.getEstimatorParams());
    expectSame(exampleWarpParams(), params.warp);
    expectSame(exampleWarpParams(), params.getWarpParams());
}

TEST(RSAckermann_Storage, save_and_load_corrector)
{
    checkSaveAndLoad<RollingShutterCorrector>(exampleCorrectorParams(), "rsackermann_RollingShutterCorrector");
}

TEST(RSAckermann_Storage, reading_corrector_is_all_or_nothing)
{
    checkAllOrNothing<RollingShutterCorrector>(exampleCorrectorParams(),
                                               "warp:\n   tolerance: -1\nestimator:\n   seed: 9\n");
}

}} // namespace
