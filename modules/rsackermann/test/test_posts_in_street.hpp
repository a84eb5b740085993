// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_TEST_RSACKERMANN_POSTS_IN_STREET_HPP
#define OPENCV_TEST_RSACKERMANN_POSTS_IN_STREET_HPP

#include "test_simulator.hpp"
#include "../src/single/depth_alignment.hpp"

namespace opencv_test { namespace simulation {

//! 1/m along the optical axis when a row is read, which has seen the point P.
inline float inverseDepthOf(const Simulator& simulator, const Vec3d& P, double row)
{
    const Vec3d inRow = simulator.drive.toCamera(P, simulator.time(Point2d(0, row)));
    return float(1 / (simulator.camera.uprightRotation.t() * inRow)[2]);
}

//! The same of all pixels of a street; 0 where it isn't seen. Row by row, as no closed form of the library does it.
inline Mat1f inverseDepthsOf(const Simulator& simulator)
{
    Mat1f inverse(simulator.camera.imageSize);
    for (int y = 0; y < inverse.rows; y++)
        for (int x = 0; x < inverse.cols; x++)
        {
            Vec3d P;
            const Point2d pixel(x, y);
            inverse(y, x) =
                simulator.locate(pixel, simulator.surface(pixel), P) ? inverseDepthOf(simulator, P, y) : 0.f;
        }
    return inverse;
}

//! A camera in a street with posts of random places, what it sees of them, and an inexact motion.
struct PostsInStreet
{
    //! @param direction 1 ahead, -1 in reverse, 0 at rest. @param focal pixels. @param looksDown known pitch of the
    //! camera.
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
        yawRate = std::abs(direction) * rng.uniform(-0.8, 0.8);
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
        inverse = inverseDepthsOf(*simulator);
        for (int i = 0; i < 120; i++)
            addPost(rng);
        prior.yawRate = yawRate;
        prior.yawRateSigma = 0.01;
        motion = motionFromMetric(camera, 1.1 * yawRate, 0.8 * speed, wall, 1.2 * wall, heading);
        motion.covariance(0, 0) = 1;
        motion.expectedRaw = motion.expectedResidual = 10; // pixels
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
                inverse(y, column) =
                    std::max(inverse(y, column), inverseDepthOf(*simulator, head + f * (foot - head), y));
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

}} // namespace opencv_test::simulation

#endif // OPENCV_TEST_RSACKERMANN_POSTS_IN_STREET_HPP
