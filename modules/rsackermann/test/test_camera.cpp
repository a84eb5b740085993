// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "../src/camera/lens.hpp"

namespace opencv_test { namespace {

//! The message of the exception that check() throws; empty: none.
std::string complaint(const RollingShutterCamera& camera)
{
    try
    {
        camera.check();
    }
    catch (const cv::Exception& e)
    {
        return e.err;
    }
    return std::string();
}

TEST(RSAckermann_Camera, fromFocal)
{
    const RollingShutterCamera wide = RollingShutterCamera::fromFocal(Size(640, 380));
    EXPECT_EQ(Size(640, 380), wide.imageSize);
    EXPECT_EQ(Matx33d(576, 0, 319.5, 0, 576, 189.5, 0, 0, 1), wide.cameraMatrix);
    EXPECT_EQ(189.5, wide.referenceRow);
    EXPECT_TRUE(wide.distCoeffs.empty());
    EXPECT_EQ(Matx33d::eye(), wide.uprightRotation);
    EXPECT_EQ("", complaint(wide));
    EXPECT_DOUBLE_EQ(0.2 * 576, wide.focalSigma);
    EXPECT_EQ(0.15, wide.distortionSigma);
    EXPECT_EQ(0, RollingShutterCamera::fromFocal(Size(640, 380), 816).focalSigma);
    EXPECT_EQ(0, RollingShutterCamera::fromFocal(Size(640, 380), 816).distortionSigma);
    EXPECT_EQ(900, RollingShutterCamera::fromFocal(Size(600, 1000)).cameraMatrix(0, 0));
    EXPECT_EQ(816, RollingShutterCamera::fromFocal(Size(640, 380), 816).cameraMatrix(1, 1));
}

// Of the mount nobody knows until it is given.
TEST(RSAckermann_Camera, mount_that_is_not_given)
{
    const double degree = CV_PI / 180;
    for (const RollingShutterCamera& camera :
         {RollingShutterCamera::fromFocal(Size(640, 380), 816),
          RollingShutterCamera(Size(640, 380), Matx33d(816, 0, 319, 0, 816, 189, 0, 0, 1))})
    {
        EXPECT_DOUBLE_EQ(2 * degree, camera.rollSigma);
        EXPECT_DOUBLE_EQ(5 * degree, camera.pitchSigma);
        EXPECT_DOUBLE_EQ(5 * degree, camera.headingSigma);
        RollingShutterCamera byAngles = camera, byGravity = camera;
        byAngles.setRollPitch(0, 0.1);
        byGravity.setGravity(Vec3d(0, 1, 0));
        for (const RollingShutterCamera& given : {byAngles, byGravity})
        {
            EXPECT_EQ(0, given.rollSigma);
            EXPECT_EQ(0, given.pitchSigma);
        }
    }
    // A file that was written by hand has a rotation, or none.
    RollingShutterCamera read(Size(640, 380), Matx33d::eye());
    FileStorage bare("%YAML:1.0\nheight: 1\n", FileStorage::READ | FileStorage::MEMORY | FileStorage::FORMAT_YAML);
    read.read(bare.root());
    EXPECT_DOUBLE_EQ(2 * degree, read.rollSigma);
    FileStorage given("%YAML:1.0\nupright_rotation: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
                      "   data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]\npitch_sigma: 0.1\n",
                      FileStorage::READ | FileStorage::MEMORY | FileStorage::FORMAT_YAML);
    read.read(given.root());
    EXPECT_EQ(0, read.rollSigma);
    EXPECT_EQ(0.1, read.pitchSigma);
    EXPECT_DOUBLE_EQ(5 * degree, read.headingSigma);
    FileStorage heading("%YAML:1.0\nheading: 1.5\n",
                        FileStorage::READ | FileStorage::MEMORY | FileStorage::FORMAT_YAML);
    read.read(heading.root());
    EXPECT_EQ(1.5, read.heading);
    EXPECT_EQ(0, read.headingSigma); // as files of before have it
}

TEST(RSAckermann_Camera, fromFocal_bad_arguments)
{
    EXPECT_THROW(RollingShutterCamera::fromFocal(Size(0, 380)), cv::Exception);
    EXPECT_THROW(RollingShutterCamera::fromFocal(Size(640, -1), 800), cv::Exception);
    EXPECT_THROW(RollingShutterCamera::fromFocal(Size(640, 380), -800), cv::Exception);
    EXPECT_THROW(RollingShutterCamera::fromFocal(Size(640, 380), NaN), cv::Exception);
    EXPECT_THROW(RollingShutterCamera::fromFocal(Size(640, 380), infinity), cv::Exception);
}

TEST(RSAckermann_Camera, constructor_checks)
{
    const Matx33d K(800, 0, 320, 0, 800, 190, 0, 0, 1);
    EXPECT_NO_THROW(RollingShutterCamera(Size(640, 380), K).check());
    EXPECT_THROW(RollingShutterCamera(Size(640, 380), K, std::vector<double>(3)).check(), cv::Exception);
    EXPECT_THROW(RollingShutterCamera(Size(640, 380), K, std::vector<double>(5), LENS_FISHEYE).check(), cv::Exception);
    EXPECT_THROW(RollingShutterCamera(Size(640, 380), Matx33d::zeros()).check(), cv::Exception);
}

TEST(RSAckermann_Camera, empty_camera_is_incomplete)
{
    EXPECT_NE(std::string::npos, complaint(RollingShutterCamera()).find("imageSize"));
}

// Gravity in the camera frame is (sin roll, cos roll cos pitch, sin pitch) up to its length.
TEST(RSAckermann_Camera, roll_and_pitch_signs)
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(640, 380));

    // turned clockwise seen from behind: the camera's right side is lower, so gravity has a part to the right
    camera.setRollPitch(0.3, 0);
    EXPECT_LT(cv::norm(camera.gravity() - Vec3d(std::sin(0.3), std::cos(0.3), 0)), 1e-15);
    EXPECT_LT(cv::norm(camera.uprightRotation * Vec3d(1, 0, 0) - Vec3d(std::cos(0.3), std::sin(0.3), 0)), 1e-15);

    // looking down: the optical axis goes down in the upright frame
    camera.setRollPitch(0, 0.3);
    EXPECT_LT(cv::norm(camera.gravity() - Vec3d(0, std::cos(0.3), std::sin(0.3))), 1e-15);
    EXPECT_LT(cv::norm(camera.uprightRotation * Vec3d(0, 0, 1) - Vec3d(0, std::sin(0.3), std::cos(0.3))), 1e-15);

    RNG& rng = theRNG();
    for (int i = 0; i < 1000; i++)
    {
        const double roll = rng.uniform(-1.5, 1.5), pitch = rng.uniform(-1.5, 1.5);
        camera.setRollPitch(roll, pitch);
        const Vec3d expected(std::sin(roll), std::cos(roll) * std::cos(pitch), std::sin(pitch));
        ASSERT_LT(cv::norm(camera.gravity() - cv::normalize(expected)), 1e-14) << roll << " " << pitch;
        ASSERT_EQ("", complaint(camera));
    }
}

// The upright frame has gravity along +y and the optical axis, projected to the horizontal, along +z.
TEST(RSAckermann_Camera, upright_frame)
{
    RNG& rng = theRNG();
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(640, 380));
    for (int i = 0; i < 1000; i++)
    {
        const double z = rng.gaussian(1), y = rng.gaussian(1), x = rng.gaussian(1);
        const Vec3d direction = cv::normalize(Vec3d(x, y, z));
        camera.setGravity(direction * std::exp(rng.uniform(-5., 5.)));
        const Matx33d& R = camera.uprightRotation;
        ASSERT_LT(cv::norm(R * R.t() - Matx33d::eye()), 1e-12);
        ASSERT_NEAR(1, cv::determinant(R), 1e-12);
        ASSERT_LT(cv::norm(R * direction - Vec3d(0, 1, 0)), 1e-12);
        const Vec3d axis = R * Vec3d(0, 0, 1);
        ASSERT_NEAR(0, axis[0], 1e-12);
        ASSERT_GT(axis[2], 0);
        ASSERT_LT(cv::norm(camera.gravity() - direction), 1e-12);
        ASSERT_EQ("", complaint(camera));
    }
}

TEST(RSAckermann_Camera, upright_bad_arguments)
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(640, 380));
    EXPECT_THROW(camera.setGravity(Vec3d()), cv::Exception);
    EXPECT_THROW(camera.setGravity(Vec3d(0, 0, 1)), cv::Exception);
    EXPECT_THROW(camera.setGravity(Vec3d(0, 0, -9.81)), cv::Exception);
    EXPECT_THROW(camera.setGravity(Vec3d(NaN, 1, 0)), cv::Exception);
    EXPECT_THROW(camera.setGravity(Vec3d(0, infinity, 0)), cv::Exception);
    EXPECT_THROW(camera.setRollPitch(NaN, 0), cv::Exception);
    EXPECT_THROW(camera.setRollPitch(0, infinity), cv::Exception);
    EXPECT_THROW(camera.setRollPitch(0, CV_PI / 2), cv::Exception);
    EXPECT_EQ(Matx33d::eye(), camera.uprightRotation);
}

TEST(RSAckermann_Camera, row_time)
{
    RollingShutterCamera camera(Size(640, 380), Matx33d(400, 0, 319.5, 0, 500, 189.5, 0, 0, 1));
    const Point2d pixel(420, 100);

    camera.scanDirection = SCAN_TOP_TO_BOTTOM;
    EXPECT_DOUBLE_EQ((100 - 189.5) / 500, camera.rowTime(pixel));
    EXPECT_TRUE(camera.isRowShutter());

    camera.scanDirection = SCAN_BOTTOM_TO_TOP;
    EXPECT_DOUBLE_EQ((189.5 - 100) / 500, camera.rowTime(pixel));
    EXPECT_TRUE(camera.isRowShutter());

    camera.referenceRow = 0;
    EXPECT_DOUBLE_EQ(-100. / 500, camera.rowTime(pixel));

    camera.scanDirection = SCAN_LEFT_TO_RIGHT;
    camera.referenceRow = 319.5;
    EXPECT_DOUBLE_EQ((420 - 319.5) / 500, camera.rowTime(pixel));
    EXPECT_FALSE(camera.isRowShutter());

    camera.scanDirection = SCAN_RIGHT_TO_LEFT;
    EXPECT_DOUBLE_EQ((319.5 - 420) / 500, camera.rowTime(pixel));
    EXPECT_FALSE(camera.isRowShutter());
}

TEST(RSAckermann_Camera, seconds_per_unit_time)
{
    RollingShutterCamera camera(Size(640, 380), Matx33d(400, 0, 319.5, 0, 500, 189.5, 0, 0, 1));
    EXPECT_EQ(0, camera.secondsPerUnitTime());
    camera.lineDelay = 2e-5;
    EXPECT_DOUBLE_EQ(0.01, camera.secondsPerUnitTime());
    // a line takes the line delay, rows and columns alike
    for (int scan : {SCAN_TOP_TO_BOTTOM, SCAN_BOTTOM_TO_TOP, SCAN_LEFT_TO_RIGHT, SCAN_RIGHT_TO_LEFT})
    {
        camera.scanDirection = scan;
        const Point2d line = camera.isRowShutter() ? Point2d(0, 1) : Point2d(1, 0);
        const double step = camera.rowTime(11 * line) - camera.rowTime(10 * line);
        EXPECT_NEAR(2e-5, std::abs(step) * camera.secondsPerUnitTime(), 1e-18) << scan;
    }
}

// Up to the largest radius that has an image, wherever that is in the raw image.
TEST(RSAckermann_Camera, lens_is_inverted_up_to_its_end)
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(640, 380));
    const double coefficients[][2] = {{0.3, -0.1}, {0.6, -0.3}, {-0.3, 0.1}, {-0.3, 0}, {0.2, 0}, {-0.2, -0.02}};
    for (const auto& k : coefficients)
    {
        camera.distCoeffs = {k[0], k[1], 0, 0};
        const Lens<double> lens(camera);
        const double end = std::min(std::sqrt(lens.maxRadius2), 3.);
        for (int i = 1; i < 500; i++)
        {
            const Point2d ray = Point2d(0.6, -0.8) * (end * i / 500);
            Point2d raw, found;
            ASSERT_TRUE(lens.project(ray.x, ray.y, raw.x, raw.y));
            EXPECT_TRUE(unproject(lens, raw, found)) << k[0] << " " << k[1] << " " << i;
            EXPECT_LT(cv::norm(found - ray), 1e-6) << k[0] << " " << k[1] << " " << i;
        }
    }
}

TEST(RSAckermann_Camera, lens_coefficients)
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(640, 380));
    for (int n = 0; n <= 16; n++)
    {
        camera.distCoeffs.assign(n, 0.01);
        camera.lensModel = LENS_PINHOLE;
        EXPECT_EQ(n == 0 || n == 4 || n == 5 || n == 8 || n == 12 || n == 14, complaint(camera).empty()) << n;
        camera.lensModel = LENS_FISHEYE;
        EXPECT_EQ(n == 0 || n == 4, complaint(camera).empty()) << n;
    }
}

typedef void (*Spoil)(RollingShutterCamera&);
typedef std::pair<const char*, Spoil> BadField;
class RSAckermann_CameraCheck : public testing::TestWithParam<BadField>
{
};

TEST_P(RSAckermann_CameraCheck, names_the_field)
{
    RollingShutterCamera camera = exampleCamera();
    ASSERT_EQ("", complaint(camera));
    GetParam().second(camera);
    EXPECT_NE(std::string::npos, complaint(camera).find(GetParam().first)) << complaint(camera);
}

const BadField badFields[] = {
    BadField("imageSize", [](RollingShutterCamera& c) { c.imageSize = Size(0, 380); }),
    BadField("imageSize", [](RollingShutterCamera& c) { c.imageSize = Size(640, 0); }),
    BadField("imageSize", [](RollingShutterCamera& c) { c.imageSize = Size(-640, -380); }),
    BadField("cameraMatrix", [](RollingShutterCamera& c) { c.cameraMatrix(0, 0) = NaN; }),
    BadField("cameraMatrix", [](RollingShutterCamera& c) { c.cameraMatrix(1, 1) = infinity; }),
    BadField("cameraMatrix", [](RollingShutterCamera& c) { c.cameraMatrix(0, 0) = 0; }),
    BadField("cameraMatrix", [](RollingShutterCamera& c) { c.cameraMatrix(0, 0) = 3e307; }),
    BadField("cameraMatrix", [](RollingShutterCamera& c) { c.cameraMatrix(1, 1) = 1e-300; }),
    BadField("cameraMatrix", [](RollingShutterCamera& c) { c.cameraMatrix(1, 2) = -1e200; }),
    BadField("cameraMatrix", [](RollingShutterCamera& c) { c.cameraMatrix(1, 1) = -800; }),
    BadField("cameraMatrix", [](RollingShutterCamera& c) { c.cameraMatrix(0, 2) = NaN; }),
    BadField("cameraMatrix", [](RollingShutterCamera& c) { c.cameraMatrix(0, 1) = 1; }),
    BadField("cameraMatrix", [](RollingShutterCamera& c) { c.cameraMatrix(2, 2) = 2; }),
    BadField("cameraMatrix", [](RollingShutterCamera& c) { c.cameraMatrix(2, 0) = 0.1; }),
    BadField("distCoeffs", [](RollingShutterCamera& c) { c.distCoeffs.resize(3); }),
    BadField("distCoeffs", [](RollingShutterCamera& c) { c.distCoeffs[4] = NaN; }),
    BadField("distCoeffs", [](RollingShutterCamera& c) { c.distCoeffs[1] = 3.8e307; }),
    BadField("distCoeffs", [](RollingShutterCamera& c) { c.distCoeffs[0] = -infinity; }),
    BadField("distCoeffs", [](RollingShutterCamera& c) { c.lensModel = LENS_FISHEYE; }),
    BadField("lensModel", [](RollingShutterCamera& c) { c.lensModel = 2; }),
    BadField("lensModel", [](RollingShutterCamera& c) { c.lensModel = -1; }),
    BadField("scanDirection", [](RollingShutterCamera& c) { c.scanDirection = 4; }),
    BadField("scanDirection", [](RollingShutterCamera& c) { c.scanDirection = -1; }),
    BadField("lineDelay", [](RollingShutterCamera& c) { c.lineDelay = -1e-5; }),
    BadField("lineDelay", [](RollingShutterCamera& c) { c.lineDelay = NaN; }),
    BadField("lineDelay", [](RollingShutterCamera& c) { c.lineDelay = 4.9e-324; }),
    BadField("lineDelay", [](RollingShutterCamera& c) { c.lineDelay = infinity; }),
    BadField("lineDelay is 0.0027 s, 1.0341 s for 383 lines; up to 1 s",
             [](RollingShutterCamera& c) { c.lineDelay = 2.7e-3; }),
    BadField("for 641 lines",
             [](RollingShutterCamera& c) {
                 c.lineDelay = 1.6e-3;
                 c.scanDirection = SCAN_LEFT_TO_RIGHT;
             }),
    BadField("referenceRow", [](RollingShutterCamera& c) { c.referenceRow = NaN; }),
    BadField("referenceRow", [](RollingShutterCamera& c) { c.referenceRow = -infinity; }),
    BadField("uprightRotation", [](RollingShutterCamera& c) { c.uprightRotation = Matx33d::zeros(); }),
    BadField("uprightRotation", [](RollingShutterCamera& c) { c.uprightRotation = -c.uprightRotation; }),
    BadField("uprightRotation", [](RollingShutterCamera& c) { c.uprightRotation *= 1.01; }),
    BadField("uprightRotation", // with a yaw
             [](RollingShutterCamera& c) {
                 c.uprightRotation = Matx33d(0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8) * c.uprightRotation;
             }),
    BadField("uprightRotation", // backward
             [](RollingShutterCamera& c) { c.uprightRotation = Matx33d::diag(Vec3d(-1, 1, -1)) * c.uprightRotation; }),
    BadField("uprightRotation", [](RollingShutterCamera& c) { c.uprightRotation(1, 2) = NaN; }),
    BadField("heading", [](RollingShutterCamera& c) { c.heading = NaN; }),
    BadField("heading", [](RollingShutterCamera& c) { c.heading = infinity; }),
    BadField("height", [](RollingShutterCamera& c) { c.height = -1; }),
    BadField("height", [](RollingShutterCamera& c) { c.height = NaN; }),
    BadField("height", [](RollingShutterCamera& c) { c.height = infinity; }),
    BadField("headingSigma", [](RollingShutterCamera& c) { c.headingSigma = -1; }),
    BadField("headingSigma", [](RollingShutterCamera& c) { c.headingSigma = NaN; }),
    BadField("rollSigma", [](RollingShutterCamera& c) { c.rollSigma = -1; }),
    BadField("rollSigma", [](RollingShutterCamera& c) { c.rollSigma = NaN; }),
    BadField("pitchSigma", [](RollingShutterCamera& c) { c.pitchSigma = -1; }),
    BadField("pitchSigma", [](RollingShutterCamera& c) { c.pitchSigma = NaN; }),
    BadField("focalSigma", [](RollingShutterCamera& c) { c.focalSigma = -1; }),
    BadField("focalSigma", [](RollingShutterCamera& c) { c.focalSigma = NaN; }),
    BadField("distortionSigma", [](RollingShutterCamera& c) { c.distortionSigma = -0.1; }),
    BadField("distortionSigma", [](RollingShutterCamera& c) { c.distortionSigma = NaN; }),
    BadField("lineDelaySigma", [](RollingShutterCamera& c) { c.lineDelaySigma = -1e-6; }),
    BadField("lineDelaySigma", [](RollingShutterCamera& c) { c.lineDelaySigma = infinity; }),
};
INSTANTIATE_TEST_CASE_P(/*nothing*/, RSAckermann_CameraCheck, testing::ValuesIn(badFields));

// As calibrateCamera() and fisheye::calibrate() return them.
TEST(RSAckermann_Camera, coefficients_in_a_matrix)
{
    const std::vector<double> expected = {0.25, -0.5, 0.125, 0};
    for (const Size& size : {Size(4, 1), Size(1, 4)})
        for (int depth : {CV_32F, CV_64F})
        {
            Mat dist;
            Mat(expected).reshape(1, size.height).convertTo(dist, depth);
            EXPECT_EQ(expected, RollingShutterCamera(Size(640, 380), Matx33d::eye(), dist).distCoeffs) << size;
        }
    for (Mat dist : {Mat(2, 2, CV_64F, Scalar(0)), Mat(1, 4, CV_8U, Scalar(0)), Mat(1, 2, CV_64FC2, Scalar(0))})
        EXPECT_THROW(RollingShutterCamera(Size(640, 380), Matx33d::eye(), dist).check(), cv::Exception) << dist;
}

}} // namespace
