// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_storage.hpp"

namespace opencv_test { namespace {

TEST(RSAckermann_Storage, camera)
{
    checkStorage(exampleCamera(), "line_delay", &RollingShutterCamera::lineDelay);
}

TEST(RSAckermann_Storage, camera_without_distortion)
{
    RollingShutterCamera camera = exampleCamera();
    camera.distCoeffs.clear();
    for (const char* suffix : {".yml", ".xml", ".json"})
    {
        RollingShutterCamera restored = exampleCamera();
        readFrom(written(camera, suffix), restored);
        expectSame(camera, restored);
        const std::string file = cv::tempfile(suffix);
        WarpMapGenerator::create(camera)->save(file);
        expectSame(camera, WarpMapGenerator::load(file)->getCamera());
        std::remove(file.c_str());
    }
}

TEST(RSAckermann_Storage, motion)
{
    checkStorage(exampleMotion(), "alpha", &AckermannMotion::alpha);
}

TEST(RSAckermann_Storage, motion_without_offset_and_curve)
{
    AckermannMotion motion = exampleMotion(), restored = motion;
    motion.inverseDepthOffset.release();
    motion.offsetArea = Rect2d();
    motion.rotationCurve.release();
    readFrom(written(motion, ".yml"), restored);
    expectSame(motion, restored);
}

TEST(RSAckermann_Storage, offset_of_another_type)
{
    for (const char* type : {"f", "2d", "512d", "u"})
    {
        AckermannMotion motion = exampleMotion();
        const std::string text =
            format("%%YAML:1.0\n---\nvalue:\n   offset_area: [ 0., 0., 1., 1. ]\n   inverse_depth_offset: "
                   "!!opencv-matrix\n      rows: 4\n      cols: 4\n      dt: %s\n      data: [ 1 ]\n",
                   type);
        EXPECT_THROW(readFrom(text, motion), cv::Exception) << type;
        expectSame(exampleMotion(), motion);
    }
}

TEST(RSAckermann_Storage, prior)
{
    checkStorage(examplePrior(), "yaw_rate", &MotionPrior::yawRate);
}

TEST(RSAckermann_Storage, estimator_params)
{
    checkStorage(exampleEstimatorParams(), "threshold", &AckermannEstimator::Params::threshold);
}

TEST(RSAckermann_Storage, warp_params)
{
    checkStorage(exampleWarpParams(), "tolerance", &WarpMapGenerator::Params::tolerance);
}

TEST(RSAckermann_Storage, save_and_load)
{
    checkSaveAndLoad<AckermannEstimator>(exampleEstimatorParams(), "rsackermann_AckermannEstimator");
    checkSaveAndLoad<WarpMapGenerator>(exampleWarpParams(), "rsackermann_WarpMapGenerator");
}

TEST(RSAckermann_Storage, load_of_a_part_of_a_file)
{
    checkCutFiles<AckermannEstimator>(exampleEstimatorParams());
    checkCutFiles<WarpMapGenerator>(exampleWarpParams());
}

// What isn't written by hand has its default.
TEST(RSAckermann_Storage, load_of_a_file_by_hand)
{
    const std::string file = cv::tempfile(".yml");
    std::ofstream(file) << "%YAML:1.0\n---\nmine:\n   camera:\n      image_width: 64\n      image_height: 48\n"
                        << "   tolerance: 0.25\n";
    const Ptr<WarpMapGenerator> loaded = WarpMapGenerator::load(file);
    remove(file.c_str());
    RollingShutterCamera camera;
    camera.imageSize = Size(64, 48);
    WarpMapGenerator::Params params;
    params.tolerance = 0.25;
    expectSame(camera, loaded->getCamera());
    expectSame(params, loaded->getParams());
}

// Another file, with a list or a number at its top, is named.
TEST(RSAckermann_Storage, load_of_another_file)
{
    const std::string name = cv::tempfile(".yml");
    for (const char* content : {"a: 3", "a: [ 1, 2 ]", "a:\n   camera: 1"})
    {
        std::ofstream(name) << "%YAML:1.0\n---\n" << content << "\n";
        try
        {
            WarpMapGenerator::load(name);
            ADD_FAILURE() << content;
        }
        catch (const cv::Exception& e)
        {
            EXPECT_NE(std::string::npos, e.err.find(name)) << content << ": " << e.what();
        }
    }
    std::remove(name.c_str());
}

//! Reads a matrix of another size, none of which memory is taken for.
template <class Struct>
void checkSizeOfMatrix(const char* key)
{
    for (const char* size :
         {"rows: 80000\n   cols: 80000", "rows: -1\n   cols: -1\n   sizes: [ 80000, 80000 ]", "rows: 1\n   cols: 9"})
    {
        const FileStorage in(
            format("%%YAML:1.0\n---\n%s: !!opencv-matrix\n   %s\n   dt: d\n   data: [ 1. ]\n", key, size),
            FileStorage::READ | FileStorage::MEMORY);
        try
        {
            Struct().read(in.root());
            FAIL() << size;
        }
        catch (const cv::Exception& e)
        {
            EXPECT_EQ(Error::StsBadArg, e.code) << e.what();
            EXPECT_NE(std::string::npos, e.err.find(key)) << e.what();
        }
    }
}

TEST(RSAckermann_Storage, size_of_matrices)
{
    checkSizeOfMatrix<RollingShutterCamera>("camera_matrix");
    checkSizeOfMatrix<RollingShutterCamera>("upright_rotation");
    checkSizeOfMatrix<AckermannMotion>("covariance");
    checkSizeOfMatrix<AckermannMotion>("inverse_depth_offset");
    checkSizeOfMatrix<AckermannMotion>("rotation_curve");
}

// As OpenCV's samples for calibration write them.
TEST(RSAckermann_Storage, coefficients_in_a_matrix)
{
    const auto readCoefficients = [](const std::string& matrix) {
        RollingShutterCamera camera;
        camera.read(
            FileStorage("%YAML:1.0\n---\ndistortion_coefficients: " + matrix, FileStorage::READ | FileStorage::MEMORY)
                .root());
        return camera.distCoeffs;
    };
    const std::vector<double> expected = {-0.25, 0.125, 0, 0.5};
    EXPECT_EQ(expected, readCoefficients("[ -0.25, 0.125, 0., 0.5 ]\n"));
    EXPECT_EQ(expected, readCoefficients("!!opencv-matrix\n   rows: 4\n   cols: 1\n   dt: d\n"
                                         "   data: [ -0.25, 0.125, 0., 0.5 ]\n"));
    EXPECT_EQ(expected, readCoefficients("!!opencv-matrix\n   rows: 1\n   cols: 4\n   dt: f\n"
                                         "   data: [ -0.25, 0.125, 0., 0.5 ]\n"));
    try
    {
        readCoefficients("!!opencv-matrix\n   rows: 2\n   cols: 2\n   dt: d\n   data: [ 0., 0., 0., 0. ]\n");
        FAIL() << "no exception";
    }
    catch (const cv::Exception& e)
    {
        EXPECT_NE(std::string::npos, e.err.find("distortion_coefficients is 2 x 2")) << e.err;
    }
    EXPECT_THROW(readCoefficients("!!opencv-matrix\n   rows: 1\n   cols: 2000000000\n   dt: d\n   data: [ 0. ]\n"),
                 cv::Exception);
}

TEST(RSAckermann_Storage, reading_is_all_or_nothing)
{
    checkAllOrNothing<AckermannEstimator>(exampleEstimatorParams(), "threshold: -1\nseed: 9\ncamera:\n   height: 2\n");
    checkAllOrNothing<AckermannEstimator>(exampleEstimatorParams(),
                                          "seed: 9\ncamera:\n   height: -2\n   heading: 0.1\n");
    checkAllOrNothing<WarpMapGenerator>(exampleWarpParams(),
                                        "tolerance: -1\nmax_iterations: 9\ncamera:\n   height: 2\n");

    // A whole camera that is good, before parameters that aren't.
    RollingShutterCamera other = exampleCamera();
    other.height = 2;
    FileStorage out(".yml", FileStorage::WRITE | FileStorage::MEMORY);
    AckermannEstimator::create(other)->write(out);
    std::string text = out.releaseAndGetString();
    const std::string key = "reverse_probability: ";
    text.replace(text.find(key), key.size(), key + "-");
    const Ptr<AckermannEstimator> estimator = AckermannEstimator::create(exampleCamera());
    EXPECT_THROW(estimator->read(FileStorage(text, FileStorage::READ | FileStorage::MEMORY).root()), cv::Exception);
    expectSame(exampleCamera(), estimator->getCamera());
}

}} // namespace
