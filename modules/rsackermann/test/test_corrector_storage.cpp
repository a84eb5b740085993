// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_corrector_common.hpp"
#include "test_storage.hpp"
#include "opencv2/rsackermann/calibration.hpp"

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

TEST(RSAckermann_Storage, load_of_a_part_of_the_file_of_a_corrector)
{
    checkCutFiles<RollingShutterCorrector>(exampleCorrectorParams());
    checkCutFiles<MountCalibrator>(MountCalibrator::Params());
}

TEST(RSAckermann_Storage, reading_corrector_is_all_or_nothing)
{
    checkAllOrNothing<RollingShutterCorrector>(exampleCorrectorParams(),
                                               "warp:\n   tolerance: -1\nestimator:\n   seed: 9\n");
    // A camera that is valid, but none for a calibration.
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(exampleCamera());
    const FileStorage in("%YAML:1.0\n---\nmax_frames: 177\ncamera:\n   scan_direction: 2\n",
                         FileStorage::READ | FileStorage::MEMORY);
    EXPECT_THROW(calibrator->read(in.root()), cv::Exception);
    EXPECT_EQ(MountCalibrator::Params().maxFrames, calibrator->getParams().maxFrames);
    expectSame(exampleCamera(), calibrator->getCamera());
}

template <class Algorithm>
void expectRefusal(const std::string& file, const std::string& objname, const std::string& stored)
{
    const std::string own = Algorithm::create(exampleCamera())->getDefaultName();
    if (own == stored)
    {
        EXPECT_NO_THROW(Algorithm::load(file, objname)) << own;
        return;
    }
    try
    {
        Algorithm::load(file, objname);
        ADD_FAILURE() << own << " was loaded from a file of " << stored;
    }
    catch (const cv::Exception& e)
    {
        EXPECT_NE(std::string::npos, e.err.find(stored)) << e.err;
        EXPECT_NE(std::string::npos, e.err.find(own)) << e.err;
    }
    const FileStorage in(file, FileStorage::READ);
    EXPECT_THROW(Algorithm::create(exampleCamera())->read(in.getFirstTopLevelNode()), cv::Exception) << own;
}

template <class Algorithm>
void checkOthersRefuse()
{
    const Ptr<Algorithm> saved = Algorithm::create(exampleCamera());
    const std::string file = cv::tempfile(".yml");
    for (const std::string& objname : {std::string(), std::string("of_the_user")})
    {
        if (objname.empty())
            saved->save(file);
        else
        {
            FileStorage out(file, FileStorage::WRITE);
            out.startWriteStruct(objname, FileNode::MAP);
            saved->write(out);
            out.endWriteStruct();
        }
        expectRefusal<AckermannEstimator>(file, objname, saved->getDefaultName());
        expectRefusal<WarpMapGenerator>(file, objname, saved->getDefaultName());
        expectRefusal<RollingShutterCorrector>(file, objname, saved->getDefaultName());
        expectRefusal<MountCalibrator>(file, objname, saved->getDefaultName());
    }
    remove(file.c_str());
}

// Parameters that are missing keep their values: the file of another algorithm would be one without any.
TEST(RSAckermann_Storage, files_of_other_algorithms)
{
    checkOthersRefuse<AckermannEstimator>();
    checkOthersRefuse<WarpMapGenerator>();
    checkOthersRefuse<RollingShutterCorrector>();
    checkOthersRefuse<MountCalibrator>();
}

}} // namespace
