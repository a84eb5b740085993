// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_rotation_curve.hpp"
#include "test_simulator.hpp"
#include "../src/motion/row_tilt.hpp"

// How rows turn beyond their rates. What maps and points make of it is in test_warp_*.cpp.

namespace opencv_test { namespace {

TEST(RSAckermann_RowTilt, curve_is_a_natural_spline_through_its_values)
{
    RNG rng(5);
    for (int vectors : {2, 3, 4, 9, 40})
        for (int scan : {SCAN_TOP_TO_BOTTOM, SCAN_BOTTOM_TO_TOP, SCAN_LEFT_TO_RIGHT, SCAN_RIGHT_TO_LEFT})
        {
            RollingShutterCamera camera = exampleCamera();
            camera.scanDirection = scan;
            AckermannMotion motion;
            addRotationCurve(motion, vectors, rng);
            const RotationCurve curve(camera, motion.rotationCurve);
            const std::function<Vec3d(double)> truth = rotationCurveOf(camera, motion);
            const Size last = camera.imageSize - Size(1, 1);
            for (int i = 0; i < vectors; i++)
            {
                const double part = double(i) / (vectors - 1),
                             time = camera.rowTime(Point2d(part * last.width, part * last.height));
                EXPECT_LT(cv::norm(curve.at(time) - Vec3d(motion.rotationCurve.ptr<double>(i))), 1e-14);
            }
            for (double part = -0.3; part < 1.3; part += 0.017) // beyond the image, too
            {
                const double time = camera.rowTime(Point2d(part * last.width, part * last.height));
                EXPECT_LT(cv::norm(curve.at(time) - truth(time)), 1e-13) << vectors << " vectors, " << part;
            }
        }
}

// The rotation of a row is that of its vector, whatever its length, after roll and pitch.
TEST(RSAckermann_RowTilt, rotation_is_that_of_the_vector)
{
    const RollingShutterCamera camera = exampleCamera();
    const double last = camera.rowTime(Point2d(0, camera.imageSize.height - 1));
    for (double length : {0., 1e-9, 1e-3, 0.2, 0.6, 3.1})
    {
        AckermannMotion motion;
        const Vec3d vector = Vec3d(0.6, -0.48, 0.64) * length;
        motion.rotationCurve = Mat::zeros(2, 3, CV_64F);
        Mat(vector.t()).copyTo(motion.rotationCurve.row(1));
        Matx33d expected, pitch, roll;
        Rodrigues(vector, expected);
        EXPECT_LT(cv::norm(RowTilt(camera, motion).at(last), expected), 1e-14) << length;
        motion.pitchRate = 0.3;
        motion.rollRate = -0.4;
        Rodrigues(Vec3d(-0.3 * last, 0, 0), pitch);
        Rodrigues(Vec3d(0, 0, -0.4 * last), roll);
        EXPECT_LT(cv::norm(RowTilt(camera, motion).at(last), roll * pitch * expected), 1e-14) << length;
        Matx33d R;
        Vec3d T;
        motion.pose(camera, last, R, T);
        const Matx33d& up = camera.uprightRotation;
        EXPECT_LT(cv::norm(R, up.t() * roll * pitch * expected * up), 1e-14) << length;
    }
}

TEST(RSAckermann_RowTilt, bad_curves_are_refused)
{
    const RollingShutterCamera camera = exampleCamera();
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const auto expectRefused = [&](const Mat& curve, const char* words) {
        AckermannMotion motion;
        motion.status = MOTION_OK;
        motion.rotationCurve = curve;
        Mat map1, map2;
        Matx33d R;
        Vec3d T;
        const std::function<void()> calls[] = {[&] { generator->initRectifyMap(motion, map1, map2); },
                                               [&] { generator->correctPoints(motion, Mat(Matx12d(1, 2)), map1); },
                                               [&] { motion.pose(camera, 0, R, T); }};
        for (const auto& call : calls)
            try
            {
                call();
                FAIL() << words;
            }
            catch (const cv::Exception& e)
            {
                EXPECT_EQ(Error::StsBadArg, e.code);
                EXPECT_NE(std::string::npos, e.err.find(words)) << e.err;
            }
    };
    expectRefused(Mat::zeros(1, 3, CV_64F), "motion.rotationCurve is a 1 x 3 matrix of type CV_64FC1; from 2 x 3 to");
    expectRefused(Mat::zeros(1025, 3, CV_64F), "motion.rotationCurve is a 1025 x 3 matrix");
    expectRefused(Mat::zeros(4, 2, CV_64F), "motion.rotationCurve is a 4 x 2 matrix");
    expectRefused(Mat::zeros(4, 3, CV_32F), "of type CV_32FC1");
    Mat bad = Mat::zeros(4, 3, CV_64F);
    bad.at<double>(2, 1) = -3.2;
    expectRefused(bad, "row 2 of motion.rotationCurve is a rotation by 3.2");
    bad.at<double>(2, 1) = NaN;
    expectRefused(bad, "row 2 of motion.rotationCurve");
}

// Points before the first row or behind the last one, of another image, turn on as the rows next to them.
TEST(RSAckermann_RowTilt, curve_goes_on_beyond_its_ends)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const double first = camera.rowTime(Point2d(0, 0)), last = camera.rowTime(Point2d(0, camera.imageSize.height - 1));
    const Vec3d rate(0.01, -0.02, 0.03);
    Mat vectors(9, 3, CV_64F);
    for (int i = 0; i < 9; i++)
    {
        const Vec3d vector = rate * (first + (last - first) * i / 8);
        std::copy(vector.val, vector.val + 3, vectors.ptr<double>(i));
    }
    const RotationCurve curve(camera, vectors);
    for (double part = -0.5; part < 1.6; part += 0.1)
    {
        const double time = first + part * (last - first);
        EXPECT_LT(cv::norm(curve.at(time) - rate * time), 1e-12) << part;
    }
}

}} // namespace
