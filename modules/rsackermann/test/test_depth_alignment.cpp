// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_simulator.hpp"
#include "opencv2/imgproc.hpp"
#include "../src/single/depth_alignment.hpp"

// Scale and shift of a relative depth against the simulator, in a street with posts.

namespace opencv_test { namespace {

using simulation::Simulator;

//! A camera in a street with posts of random places, what it sees of them, and an inexact motion.
struct PostsInStreet
{
    //! @param focal pixels. @param looksDown known pitch of the camera.
    explicit PostsInStreet(RNG& rng, double direction = 1, double heading = 0, double focal = 700, double looksDown = 0,
                           double lineDelay = 80e-6, double referenceRow = 189.5)
        : camera(RollingShutterCamera::fromFocal(Size(640, 380), focal))
    {
        const double wall = heading == 0 ? 5 : 25;
        camera.lineDelay = lineDelay;
        camera.referenceRow = referenceRow;
        camera.height = 1.3;
        camera.heading = heading;
        params.gravitySigma = (heading == 0 ? 0.3 : 1) * CV_PI / 180;
        params.vehiclePitchSigma = (heading == 0 ? 0.3 : 0.1) * CV_PI / 180;
        yawRate = rng.uniform(-0.8, 0.8);
        speed = direction * rng.uniform(12., 20.);
        camera.setRollPitch(0, looksDown);
        RollingShutterCamera exact = camera;
        // The car leans to one side, and its nose hardly moves.
        const double ofCar =
                         heading == 0 ? rng.uniform(-0.005, 0.005) : rng.uniform(0.01, 0.02) * (heading < 0 ? 1 : -1),
                     noseDown = heading == 0 ? rng.uniform(-0.005, 0.005) : 0;
        roll = std::cos(heading) * ofCar + std::sin(heading) * noseDown;
        pitch = std::cos(heading) * noseDown - std::sin(heading) * ofCar;
        exact.setRollPitch(roll, looksDown + pitch);
        simulator.reset(new Simulator(Simulator::fromMetric(exact, yawRate, speed, wall, 1.2 * wall, heading)));
        drawStreet();
        for (int i = 0; i < 120; i++)
            addPost(rng);
        prior.yawRate = yawRate;
        prior.yawRateSigma = 0.01;
        motion = motionFromMetric(camera, 1.1 * yawRate, 0.8 * speed, wall, 1.2 * wall, heading);
        motion.covariance(0, 0) = 1;
    }

    //! Row by row, as no closed form of the library does it.
    void drawStreet()
    {
        inverse.create(camera.imageSize);
        for (int y = 0; y < inverse.rows; y++)
            for (int x = 0; x < inverse.cols; x++)
            {
                Vec3d P;
                const Point2d pixel(x, y);
                inverse(y, x) = simulator->locate(pixel, simulator->surface(pixel), P) ? inverseDepth(P, y) : 0.f;
            }
    }

    float inverseDepth(const Vec3d& P, double row) const
    {
        const Vec3d inRow = simulator->drive.toCamera(P, simulator->time(Point2d(0, row)));
        return float(1 / (simulator->camera.uprightRotation.t() * inRow)[2]);
    }

    //! A flat one, whose left edge is a segment, where no other one is.
    void addPost(RNG& rng)
    {
        const double z = rng.uniform(5., 20.), x = rng.uniform(-0.4, 0.4) * z, top = -rng.uniform(0.5, 2.);
        const Vec3d foot(x, 1.3, z), head(x, top, z);
        Point2d a, b;
        if (!simulator->project(head, a) || !simulator->project(foot, b))
            return;
        for (const Vec4f& other : segments)
            if (std::abs(other[0] - a.x) < 20)
                return;
        segments.push_back(Vec4f(float(a.x), float(a.y), float(b.x), float(b.y)));
        for (int y = cvCeil(a.y); y <= b.y; y++)
        {
            const double f = (y - a.y) / (b.y - a.y);
            const int left = cvCeil(a.x + f * (b.x - a.x));
            for (int column = left; column < std::min(left + 8, inverse.cols); column++)
                inverse(y, column) = std::max(inverse(y, column), inverseDepth(head + f * (foot - head), y));
        }
    }

    DepthMap relative(RNG& rng) const
    {
        const double scale = std::exp(rng.gaussian(2)), shift = rng.gaussian(3);
        return DepthMap(scale * inverse + shift, DEPTH_RAW, 1, DEPTH_RELATIVE);
    }

    bool align(DepthMap& depth, AckermannMotion& m) const
    {
        Mat rows = Mat(segments).reshape(1), converted;
        rows.convertTo(converted, CV_64F);
        return alignDepth(camera, params, prior, converted, m, depth);
    }

    bool isRefused(const Mat& values) const
    {
        DepthMap depth(values, DEPTH_RAW, 1, DEPTH_RELATIVE);
        AckermannMotion m = motion;
        return !align(depth, m) && m.alpha == motion.alpha && m.roadSlope == motion.roadSlope && depth.scale == 1;
    }

    //! Of the scaled inverse depths that scale and shift give, over all of the image.
    double relativeError(const DepthMap& depth) const
    {
        Mat given;
        depth.values.convertTo(given, CV_32F, depth.scale, depth.shift);
        const double way = std::abs(speed) * camera.secondsPerUnitTime();
        return cvtest::norm(given, way * inverse, NORM_L1) / cvtest::norm(way * inverse, NORM_L1);
    }

    //! Mean pixels by which the shutter displaces what the image shows, at the places where the library looks.
    double meanDisplacement() const
    {
        const RollingShutterCamera& exact = simulator->camera;
        const int across = 9, down = 6;
        double sum = 0;
        for (int i = 0; i < across * down; i++)
        {
            const Point2d raw((i % across + 0.5) / across * inverse.cols - 0.5,
                              (i / across + 0.5) / down * inverse.rows - 0.5);
            const double t = simulator->time(raw), nearness = std::max(inverse(raw), 1e-6f);
            const Vec3d ray = exact.uprightRotation * (exact.cameraMatrix.inv() * Vec3d(raw.x, raw.y, 1)),
                        P = simulator->drive.position(t) + simulator->drive.turn(ray, t) * (1 / nearness),
                        pixel = exact.cameraMatrix * (exact.uprightRotation.t() * P);
            sum += cv::norm(raw - Point2d(pixel[0] / pixel[2], pixel[1] / pixel[2]));
        }
        return sum / (across * down);
    }

    RollingShutterCamera camera;
    AckermannEstimator::Params params;
    MotionPrior prior;
    AckermannMotion motion;
    double yawRate, speed, roll, pitch;
    std::unique_ptr<Simulator> simulator;
    std::vector<Vec4f> segments;
    Mat1f inverse; // 1/m
};

TEST(RSAckermann_DepthAlignment, finds_scale_and_shift)
{
    RNG rng(5);
    for (int round = 0; round < 8; round++)
    {
        PostsInStreet s(rng, round == 3 ? -1 : 1);
        const bool knowsSpeed = round % 2 != 0;
        s.prior.speed = s.speed;
        s.prior.speedSigma = knowsSpeed ? 0.2 : 0;
        DepthMap depth = s.relative(rng);
        AckermannMotion motion = s.motion;
        ASSERT_TRUE(s.align(depth, motion)) << round;
        const double unit = s.camera.secondsPerUnitTime();
        EXPECT_NEAR(s.yawRate, 2 * motion.alpha / unit, 0.03) << round;
        EXPECT_NEAR(1, motion.roadSlope / (s.speed * unit / s.camera.height), knowsSpeed ? 0.03 : 0.1) << round;
        EXPECT_LE(std::sqrt(motion.covariance(0, 0)), 0.0101 * unit / 2) << round;
        EXPECT_LT(motion.expectedResidual, 0.5 * motion.expectedRaw) << round;
        EXPECT_LT(motion.probabilityWorse, 0.1) << round;
    }
}

// Without values from elsewhere the verticals show yaw rate and scale, whichever way the car goes and whichever row is
// the reference.
TEST(RSAckermann_DepthAlignment, verticals_show_the_motion)
{
    RNG rng(11);
    for (const double direction : {1., -1.})
        for (const double reference : {0., 189.5, 379.})
        {
            SCOPED_TRACE(testing::Message() << direction << " " << reference);
            const int rounds = 6;
            double scale = 0;
            for (int round = 0; round < rounds; round++)
            {
                PostsInStreet s(rng, direction, 0, 700, 0, 160e-6, reference);
                s.params.gravitySigma = s.params.vehiclePitchSigma = 1e-4;
                s.camera.setRollPitch(s.roll, s.pitch);
                s.prior.yawRate = s.yawRate + 0.3;
                s.prior.yawRateSigma = 1;
                DepthMap depth = s.relative(rng);
                AckermannMotion motion = s.motion;
                ASSERT_TRUE(s.align(depth, motion));
                const double unit = s.camera.secondsPerUnitTime();
                EXPECT_NEAR(s.yawRate, 2 * motion.alpha / unit, 0.03);
                scale += motion.roadSlope / (s.speed * unit / s.camera.height) / rounds;
            }
            RecordProperty("scale", format("%.4f", scale));
            EXPECT_NEAR(1, scale, 0.02);
        }
}

// A camera that looks sideways sees the roll of the car as its own pitch.
TEST(RSAckermann_DepthAlignment, of_cameras_that_look_sideways)
{
    RNG rng(9);
    for (const double heading : {-1.2, 1.2})
    {
        PostsInStreet s(rng, 1, heading);
        DepthMap depth = s.relative(rng);
        AckermannMotion motion = s.motion;
        ASSERT_TRUE(s.align(depth, motion)) << heading;
        EXPECT_LE(s.relativeError(depth), 0.15) << heading;
        EXPECT_NEAR(s.yawRate, 2 * motion.alpha / s.camera.secondsPerUnitTime(), 0.03) << heading;
        EXPECT_NEAR(s.roll, motion.rollCorrection, 0.003) << heading;
        EXPECT_NEAR(s.pitch, motion.pitchCorrection, 0.006) << heading;
    }
}

// As far as the shutter displaces what the image shows: to first order, as that of a short read-out is.
TEST(RSAckermann_DepthAlignment, displacement)
{
    RNG rng(10);
    const double modes[][4] = {{1, 0, 700, 0},    {-1, 0, 700, 0},   {1, 0, 350, 0},
                               {1, 0, 350, 0.1},  {1, 0, 350, -0.1}, {1, 0, 350, 0.3},
                               {1, 0, 350, -0.3}, {1, 1.2, 500, 0},  {1, -1.2, 500, 0}};
    for (const auto& m : modes)
    {
        SCOPED_TRACE(testing::Message() << m[0] << " " << m[1] << " " << m[2] << " " << m[3]);
        PostsInStreet s(rng, m[0], m[1], m[2], m[3], 4e-6);
        s.prior.yawRateSigma = 0.002;
        s.prior.speed = s.speed;
        s.prior.speedSigma = 0.05;
        DepthMap depth = s.relative(rng);
        AckermannMotion motion = s.motion;
        ASSERT_TRUE(s.align(depth, motion));
        // Sideways the tilt is hardly known.
        EXPECT_NEAR(s.meanDisplacement(), motion.expectedRaw, (m[1] == 0 ? 0.04 : 0.12) * motion.expectedRaw);
    }
}

TEST(RSAckermann_DepthAlignment, without_a_yaw_rate_what_is_expected_is_uncertain)
{
    RNG rng(6);
    PostsInStreet s(rng);
    DepthMap depth = s.relative(rng), same = depth;
    AckermannMotion given = s.motion, free = s.motion;
    ASSERT_TRUE(s.align(depth, given));
    s.prior.yawRateSigma = 0;
    ASSERT_TRUE(s.align(same, free));
    EXPECT_GT(free.covariance(0, 0), 4 * given.covariance(0, 0));
    EXPECT_GT(free.expectedResidual, 1.5 * given.expectedResidual);
    EXPECT_LT(std::abs(2 * free.alpha / s.camera.secondsPerUnitTime() - s.yawRate),
              3 * 2 * std::sqrt(free.covariance(0, 0)) / s.camera.secondsPerUnitTime());
    // Normal errors of the correction exceed what they leave undone as often as it says.
    const int draws = 100000;
    int worse = 0;
    for (int i = 0; i < draws; i++)
    {
        const double error = rng.gaussian(free.expectedResidual / std::sqrt(2 / CV_PI));
        worse += std::abs(error) > std::abs(free.expectedRaw + error);
    }
    EXPECT_NEAR(double(worse) / draws, free.probabilityWorse, 0.2 * free.probabilityWorse);
    EXPECT_GT(free.probabilityWorse, 0.003);
}

TEST(RSAckermann_DepthAlignment, refuses_what_the_image_contradicts)
{
    RNG rng(7);
    for (int round = 0; round < 5; round++)
    {
        const PostsInStreet s(rng), other(rng);
        Mat mirrored, depths;
        flip(s.inverse, mirrored, 1);
        EXPECT_TRUE(s.isRefused(mirrored)) << round;
        EXPECT_TRUE(s.isRefused(other.inverse)) << round;
        EXPECT_TRUE(s.isRefused(-s.inverse)) << round;
        cv::divide(1, s.inverse + 0.01, depths);
        EXPECT_TRUE(s.isRefused(depths)) << round;
    }
}

TEST(RSAckermann_DepthAlignment, refuses_degenerate_depths)
{
    RNG rng(8);
    PostsInStreet s(rng);
    const Size size = s.camera.imageSize;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(s.isRefused(Mat(size, CV_32F, Scalar(3))));
    EXPECT_TRUE(s.isRefused(Mat::zeros(size, CV_32F)));
    EXPECT_TRUE(s.isRefused(Mat(size, CV_16U, Scalar(65535))));
    EXPECT_TRUE(s.isRefused(Mat(size, CV_32F, Scalar(nan))));
    EXPECT_TRUE(s.isRefused(Mat(size, CV_32F, Scalar(INFINITY))));
    Mat noise(size, CV_32F);
    rng.fill(noise, RNG::UNIFORM, 0, 1);
    EXPECT_TRUE(s.isRefused(noise));
    rng.fill(noise, RNG::UNIFORM, -FLT_MAX / 2, FLT_MAX / 2);
    EXPECT_TRUE(s.isRefused(noise));

    // A half of it suffices.
    DepthMap depth = s.relative(rng);
    depth.values(Rect(0, 0, size.width, size.height / 4)).setTo(nan);
    AckermannMotion motion = s.motion;
    EXPECT_TRUE(s.align(depth, motion));
    s.segments.clear();
    EXPECT_TRUE(s.isRefused(s.inverse));
}

}} // namespace opencv_test::
