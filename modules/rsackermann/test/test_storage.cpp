// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"

namespace opencv_test { namespace {

template <class Struct>
std::string written(const Struct& value, const char* format)
{
    FileStorage out(format, FileStorage::WRITE | FileStorage::MEMORY);
    out << "value"
        << "{";
    value.write(out);
    out << "}";
    return out.releaseAndGetString();
}

template <class Struct>
void readFrom(const std::string& text, Struct& value)
{
    value.read(FileStorage(text, FileStorage::READ | FileStorage::MEMORY)["value"]);
}

//! @param example value all of whose fields differ from those of the default.
//! @param key key of one field, whose value in the file is 0.
template <class Struct, class Field>
void checkStorage(const Struct& example, const char* key, Field Struct::*field)
{
    const char* const formats[] = {".yml", ".xml", ".json"};
    for (int i = 0; i < 3; i++)
    {
        Struct restored;
        readFrom(written(example, formats[i]), restored);
        expectSame(example, restored);
    }

    Struct partly = example, expected = example;
    readFrom(format("%%YAML:1.0\n---\nvalue:\n   %s: 0\n", key), partly);
    expected.*field = 0;
    expectSame(expected, partly);
    partly.read(FileNode());
    expectSame(expected, partly);
}

TEST(RSAckermann_Storage, camera)
{
    checkStorage(exampleCamera(), "line_delay", &RollingShutterCamera::lineDelay);
}

TEST(RSAckermann_Storage, camera_without_distortion)
{
    RollingShutterCamera camera = exampleCamera(), restored = camera;
    camera.distCoeffs.clear();
    readFrom(written(camera, ".yml"), restored);
    expectSame(camera, restored);
}

TEST(RSAckermann_Storage, motion)
{
    checkStorage(exampleMotion(), "alpha", &AckermannMotion::alpha);
}

TEST(RSAckermann_Storage, motion_without_relief)
{
    AckermannMotion motion = exampleMotion(), restored = motion;
    motion.inverseDepthOffset.release();
    motion.offsetArea = Rect2d();
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

template <class Algorithm>
void checkSaveAndLoad(const typename Algorithm::Params& example, const char* name)
{
    const Ptr<Algorithm> saved = Algorithm::create(exampleCamera(), example);
    EXPECT_EQ(name, saved->getDefaultName());
    const std::string file = cv::tempfile(".yml");
    saved->save(file);
    for (int byName = 0; byName < 2; byName++)
    {
        const Ptr<Algorithm> loaded = Algorithm::load(file, byName ? name : "");
        expectSame(exampleCamera(), loaded->getCamera());
        expectSame(example, loaded->getParams());
    }
    EXPECT_THROW(Algorithm::load(file, "another_name"), cv::Exception);
    remove(file.c_str());
    EXPECT_THROW(Algorithm::load(file), cv::Exception);

    // Into an algorithm that is there.
    FileStorage out(".yml", FileStorage::WRITE | FileStorage::MEMORY);
    saved->write(out);
    const FileStorage in(out.releaseAndGetString(), FileStorage::READ | FileStorage::MEMORY);
    const Ptr<Algorithm> other = Algorithm::create(RollingShutterCamera::fromFocal(Size(64, 48)));
    other->read(in.root());
    expectSame(exampleCamera(), other->getCamera());
    expectSame(example, other->getParams());
}

TEST(RSAckermann_Storage, save_and_load)
{
    checkSaveAndLoad<AckermannEstimator>(exampleEstimatorParams(), "rsackermann_AckermannEstimator");
    checkSaveAndLoad<WarpMapGenerator>(exampleWarpParams(), "rsackermann_WarpMapGenerator");
    checkSaveAndLoad<RollingShutterCorrector>(exampleCorrectorParams(), "rsackermann_RollingShutterCorrector");
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
}

//! @param text file with something that is out of range, and with other values that aren't.
template <class Algorithm>
void checkAllOrNothing(const typename Algorithm::Params& example, const char* text)
{
    const Ptr<Algorithm> algorithm = Algorithm::create(exampleCamera(), example);
    const FileStorage in(std::string("%YAML:1.0\n---\n") + text, FileStorage::READ | FileStorage::MEMORY);
    EXPECT_THROW(algorithm->read(in.root()), cv::Exception);
    expectSame(exampleCamera(), algorithm->getCamera());
    expectSame(example, algorithm->getParams());
}

TEST(RSAckermann_Storage, reading_is_all_or_nothing)
{
    checkAllOrNothing<AckermannEstimator>(exampleEstimatorParams(), "threshold: -1\nseed: 9\ncamera:\n   height: 2\n");
    checkAllOrNothing<AckermannEstimator>(exampleEstimatorParams(),
                                          "seed: 9\ncamera:\n   height: -2\n   heading: 0.1\n");
    checkAllOrNothing<WarpMapGenerator>(exampleWarpParams(),
                                        "tolerance: -1\nmax_iterations: 9\ncamera:\n   height: 2\n");
    checkAllOrNothing<RollingShutterCorrector>(exampleCorrectorParams(),
                                               "warp:\n   tolerance: -1\nestimator:\n   seed: 9\n");
}

}} // namespace
