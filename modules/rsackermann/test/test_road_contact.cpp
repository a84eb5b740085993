// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_private_problem.hpp"
#include "../src/single/refinement.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

//! Adds the images of vertical lines on the walls that stand on the road.
void addContacts(const Simulator& simulator, double height, int count, RNG& rng, Mat& segments)
{
    const Size size = simulator.camera.imageSize;
    for (int tries = 0; count > 0 && tries < 100000; tries++)
    {
        const Point2d pixel = uniformPoint(rng, Point2d(0, 0), Point2d(size.width - 1, size.height - 1));
        const simulation::Surface plane = simulator.surface(pixel);
        Vec3d foot;
        if ((plane != simulation::LEFT && plane != simulation::RIGHT) || !simulator.locate(pixel, plane, foot))
            continue;
        foot[1] = height;
        const Vec3d top = foot - Vec3d(0, rng.uniform(1., 3.), 0);
        Point2d low, high;
        if (!simulator.project(foot, low) || !simulator.project(top, high) || cv::norm(low - high) < 40 ||
            !Rect(Point(), size).contains(low) || !Rect(Point(), size).contains(high))
            continue;
        Mat row(Matx14d(low.x, low.y, high.x, high.y));
        for (int j = 0; j < 4; j++)
            row.at<double>(j) += rng.gaussian(0.3);
        segments.push_back(row);
        count--;
    }
    ASSERT_EQ(0, count);
}

// Two of three segments end anywhere on the walls; the others say how far the wall is.
TEST(RSAckermann_Estimator, scale_from_segments_that_stand_on_the_road)
{
    RNG rng(11);
    std::vector<double> distanceErrors, speedErrors;
    for (int i = 0; i < 20; i++)
    {
        const double left = rng.uniform(2., 4.), right = rng.uniform(2., 4.),
                     speed = (i % 2 ? -1 : 1) * rng.uniform(8., 30.);
        const RollingShutterCamera camera = simulation::paperCamera();
        const Simulator simulator = Simulator::fromMetric(camera, 0.5, speed, left, right, 0);
        simulation::SegmentOptions options;
        options.count = 50;
        options.inlierRatio = 0.8;
        options.noise = 0.3;
        Mat segments = simulation::randomSegments(simulator, options, rng).ends;
        addContacts(simulator, camera.height, 25, rng, segments);

        AckermannEstimator::Params params;
        params.scaleFromRoad = true;
        params.gravitySigma = 0;
        params.reverseProbability = 0.5; // as usual as forward
        MotionPrior prior; // verticals alone say little of the vanishing point, and with it of the distance
        prior.wallDirectionSigma = 0.005;
        const AckermannMotion motion = AckermannEstimator::create(camera, params)->estimate(segments, noArray(), prior);
        ASSERT_EQ(MOTION_OK, motion.status);
        ASSERT_GT(motion.wallDistance, 0);
        EXPECT_NEAR(motion.roadSlope * camera.height,
                    motion.direction * std::hypot(motion.wallSlope, motion.wallOffset) * motion.wallDistance, 1e-12);
        distanceErrors.push_back(std::abs(motion.wallDistance / left - 1));
        double found = 0;
        EXPECT_TRUE(motion.speed(camera, found));
        const double sigma = std::sqrt(motion.metricCovariance(camera)(1, 1));
        EXPECT_LT(std::abs(found - speed), 3 * sigma);
        EXPECT_LT(sigma, 0.3 * std::abs(speed));
        RollingShutterCamera other = camera;
        other.lineDelaySigma = 0.2 * camera.lineDelay;
        const AckermannMotion vague = AckermannEstimator::create(other, params)->estimate(segments, noArray(), prior);
        EXPECT_NEAR(std::hypot(motion.speedSigma, 0.2 * found), vague.speedSigma, 0.05 * vague.speedSigma);
        other.lineDelay = 0;
        EXPECT_EQ(0, AckermannEstimator::create(other, params)->estimate(segments, noArray(), prior).speedSigma);
        speedErrors.push_back(std::abs(found / speed - 1));

        params.scaleFromRoad = false;
        EXPECT_EQ(0, AckermannEstimator::create(camera, params)->estimate(segments).wallDistance);
    }
    std::sort(distanceErrors.begin(), distanceErrors.end());
    std::sort(speedErrors.begin(), speedErrors.end());
    RecordProperty("median_distance_error", format("%.3f", distanceErrors[10]));
    RecordProperty("median_speed_error", format("%.3f", speedErrors[10]));
    EXPECT_LT(distanceErrors[10], 0.1);
    EXPECT_LT(speedErrors[10], 0.15);
}

// Where segments end counts for more than a distance that they contradict.
TEST(RSAckermann_RoadContact, contradict_a_given_wall)
{
    RNG rng(14);
    const RollingShutterCamera camera = simulation::paperCamera();
    for (int i = 0; i < 10; i++)
    {
        const double left = rng.uniform(2., 4.), speed = rng.uniform(8., 15.),
                     road = speed * camera.secondsPerUnitTime() / camera.height;
        const Simulator simulator = Simulator::fromMetric(camera, 0, speed, left, rng.uniform(2., 4.), 0);
        Mat segments;
        addContacts(simulator, camera.height, 40, rng, segments);
        AckermannEstimator::Params params;
        params.gravitySigma = 0;
        MotionPrior prior; // verticals alone say little of the vanishing point, and with it of the distance
        prior.wallDirectionSigma = 0.005;
        for (const double factor : {1., 3., 0.4})
        {
            params.wallDistance = factor * left;
            params.wallDistanceLogSigma = 0.1;
            const AckermannMotion motion =
                AckermannEstimator::create(camera, params)->estimate(segments, noArray(), prior);
            ASSERT_EQ(MOTION_OK, motion.status);
            // One that is nearer contradicts none of them: ends are above the road, or agree on something else.
            const bool isNearer = factor < 1;
            EXPECT_TRUE(isNearer || motion.contradictsPrior == (factor != 1)) << factor;
            EXPECT_NEAR(0, std::log(motion.roadSlope / road), isNearer ? 0.8 * std::abs(std::log(factor)) : 0.25)
                << factor;
            double found;
            ASSERT_TRUE(motion.speed(camera, found));
            EXPECT_EQ(motion.contradictsPrior ? SCALE_ROAD : SCALE_WALL, motion.scale);
            EXPECT_TRUE(isNearer || std::abs(found - speed) < 3 * motion.speedSigma) << factor;
            EXPECT_GE(motion.speedSigma, 0.05 * found);
            EXPECT_NEAR(motion.speedSigma, std::sqrt(motion.metricCovariance(camera)(1, 1)), 1e-6 * found);

            params.wallDistanceLogSigma = 0;
            const AckermannMotion exact =
                AckermannEstimator::create(camera, params)->estimate(segments, noArray(), prior);
            ASSERT_EQ(MOTION_OK, exact.status);
            EXPECT_FALSE(exact.contradictsPrior);
            EXPECT_NEAR(std::log(factor), std::log(exact.roadSlope / road), 0.3);
            EXPECT_EQ(0, exact.speedSigma);
        }
    }
}

// Each wall tells its own distance, and what stands above the road is none.
TEST(RSAckermann_RoadContact, of_both_walls_and_of_one)
{
    RNG rng(12);
    const RollingShutterCamera camera = simulation::paperCamera();
    const double left = 3, right = 4;
    const Simulator simulator = Simulator::fromMetric(camera, 0, 12, left, right, 0);
    Mat both;
    addContacts(simulator, camera.height, 40, rng, both);
    for (int k = 0; k < 3; k++)
    {
        Mat segments;
        for (int i = 0; i < both.rows; i++)
            if (k == 0 || (both.at<double>(i, 0) < 320) == (k == 1))
                segments.push_back(both.row(i));
        const RefinementProblem problem = makeProblem(camera, AckermannEstimator::Params(), segments);
        const Model model = modelOf(simulator);
        // What is said of the road is said by the walls that have segments.
        RoadLimit limit = findRoadLimit(problem, model, 2);
        const double there = std::log(left / camera.height), far = there + std::log(1.5);
        Model none = model;
        none[P_LAMBDA] = 0; // the left wall alone
        EXPECT_EQ(k != 2, RoadLimit::Likelihood(limit, none, problem.heading)(far) < 0.5) << k;
        none[P_B] *= -1; // the right one
        none[P_D] *= -1;
        EXPECT_EQ(k != 1, RoadLimit::Likelihood(limit, none, problem.heading)(far) < 0.5) << k;
        const double near = there + std::log(0.5);
        EXPECT_NEAR(1, RoadLimit::Likelihood(limit, model, problem.heading)(near), 1e-6) << k;
        limit.addContacts();
        const double agreed = RoadLimit::Likelihood(limit, model, problem.heading)(there);
        for (const double aside : {-0.15, 0.15})
            EXPECT_LT(RoadLimit::Likelihood(limit, model, problem.heading)(there + aside), agreed) << k << " " << aside;
        EXPECT_GT(agreed, 100 * RoadLimit::Likelihood(limit, model, problem.heading)(near)) << k;
        EXPECT_GT(agreed, 100 * RoadLimit::Likelihood(limit, model, problem.heading)(far)) << k;
        EXPECT_TRUE(findRoadLimit(problem, Model(), 2).empty());
    }
}

// Whatever ends agree on is the road or something else: another distance stays as possible as what is unusual.
TEST(RSAckermann_RoadContact, ends_that_agree_may_be_of_something_else)
{
    RoadLimit limit;
    for (int i = 0; i < 50; i++)
        limit.add(false, 20 * std::exp(0.03 * (i % 5 - 2)), 1);
    limit.addContacts();
    const Model model = modelOf(Simulator::fromMetric(simulation::paperCamera(), 0, 12, 3, 0, 0));
    const Heading heading(0);
    const double there = RoadLimit::Likelihood(limit, model, heading)(std::log(20.)),
                 near = RoadLimit::Likelihood(limit, model, heading)(std::log(3.));
    EXPECT_GT(there, 20 * near);
    EXPECT_GT(near, there / 2000);
}

// In a narrow street that is passed at a usual speed the walls alone would make the road half as far away as it is.
TEST(RSAckermann_RoadContact, road_of_a_narrow_street)
{
    RNG rng(13);
    const RollingShutterCamera camera = simulation::paperCamera();
    for (int i = 0; i < 5; i++)
    {
        const double speed = 12, left = rng.uniform(1.8, 2.2), right = rng.uniform(1.8, 2.2);
        const Simulator simulator = Simulator::fromMetric(camera, 0.02, speed, left, right, 0);
        Mat segments;
        addContacts(simulator, camera.height, 30, rng, segments);
        MotionPrior prior; // roll and yaw rate are hard to distinguish, and don't matter here
        prior.yawRate = 0.02;
        prior.yawRateSigma = 0.01;
        const double G = speed * camera.secondsPerUnitTime() / camera.height;
        AckermannEstimator::Params params;
        params.gravitySigma = params.vehiclePitchSigma = 0.2 * CV_PI / 180;
        const AckermannMotion motion = AckermannEstimator::create(camera, params)->estimate(segments, noArray(), prior);
        ASSERT_EQ(MOTION_OK, motion.status);
        EXPECT_NEAR(G, motion.roadSlope, 0.4 * G); // the contacts are an upper limit
        EXPECT_EQ(SCALE_UNKNOWN, motion.scale) << "it is no measurement";
    }
}

}} // namespace
