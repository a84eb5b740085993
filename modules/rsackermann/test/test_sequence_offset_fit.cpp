// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_inverse_depth_offset.hpp"
#include "test_simulator.hpp"
#include "../src/sequence/offset_fit.hpp"

// Scenes that deviate from their planes: how tracked points show them.

namespace opencv_test { namespace {

using simulation::Simulator;

//! A drive past things that stand before and behind the planes of its street.
struct BumpyStreet
{
    RollingShutterCamera camera;
    AckermannMotion motion; // with the true offset
    Simulator simulator;
    double values[FLOW_VALUES];

    BumpyStreet(double speed, double deviation, RNG& rng)
        : camera(Size(960, 540), Matx33d(700, 0, 470, 0, 840, 280, 0, 0, 1)), simulator(camera, Drive(), Street()),
          values()
    {
        camera.lineDelay = 0.03 / 540;
        camera.height = 1.3;
        camera.heading = 0.05;
        camera.setRollPitch(0.01, 0.04);
        const double yawRate = rng.uniform(-0.3, 0.3), unit = camera.secondsPerUnitTime();
        simulator = Simulator::fromMetric(camera, yawRate, speed, 6, 9, 0.1);
        SequenceState state(camera, AckermannEstimator::Params());
        const double known[] = {yawRate, speed, 0.1, 1 / 6., 1 / 9., 1 / 1.3, 0, 0};
        std::copy(known, known + SEQUENCE_VALUES, state.value.val);
        std::copy(known, known + SEQUENCE_VALUES, values);
        state.toMotion(unit, motion);
        motion.status = MOTION_OK;
        motion.inverseDepthOffset.create(6, 9, CV_64F);
        motion.offsetArea = Rect2d(-0.7, -0.4, 1.4, 0.75);
        rng.fill(motion.inverseDepthOffset, RNG::NORMAL, 0, deviation * speed * unit);
    }

    //! Metres of the point that a pixel of the global-shutter camera shows.
    bool pointAt(const Point2d& pixel, Vec3d& P) const
    {
        const Vec3d b = bearingOf(camera, motion, pixel);
        const simulation::Surface plane = simulator.street.first(Vec3d(), b);
        const double perMetre = values[SEQUENCE_SPEED] * camera.secondsPerUnitTime(),
                     planes = plane == simulation::NOTHING ? 0 : 1 / simulator.street.distance(plane, Vec3d(), b),
                     nearness = planes + b[2] * offsetAt(motion, b[0] / b[2], b[1] / b[2]) / perMetre;
        P = b * (1 / nearness);
        return nearness > 0.005;
    }

    std::vector<TrackedBearing> bearings(int count, double noise, double outliers, RNG& rng) const
    {
        const double seconds = 0.05, T = seconds / camera.secondsPerUnitTime();
        std::vector<PointPair> pairs;
        for (int tries = 0; int(pairs.size()) < count && tries < 100 * count; tries++)
        {
            const Point2d pixel = uniformPoint(rng, Point2d(0, 0), Point2d(960, 540));
            PointPair pair;
            Vec3d P;
            if (!pointAt(pixel, P) || !simulator.project(P, pair.now) ||
                !simulator.project(simulator.drive.toCamera(P, -T), pair.other))
                continue;
            pair.other += gaussianPoint(rng, noise);
            if (rng.uniform(0., 1.) < outliers)
                pair.other += uniformPoint(rng, Point2d(-40, -20), Point2d(40, 20));
            pairs.push_back(pair);
        }
        std::vector<TrackedBearing> result;
        addBearings(camera, pairs, seconds, result);
        return result;
    }

    //! Mean distance in pixels of what a motion says from the truth.
    double error(const AckermannMotion& found) const
    {
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
        std::vector<Point2d> pixels, truths, raw;
        for (double y = 20; y < 530; y += 30)
            for (double x = 20; x < 950; x += 30)
            {
                Vec3d P;
                Point2d truth;
                if (!pointAt(Point2d(x, y), P) || !simulator.project(P, truth))
                    continue;
                pixels.push_back(Point2d(x, y));
                truths.push_back(truth);
            }
        generator->distortPoints(found, pixels, raw);
        double sum = 0;
        for (size_t i = 0; i < raw.size(); i++)
            sum += cv::norm(raw[i] - truths[i]);
        return sum / double(raw.size());
    }

private:
    typedef simulation::Drive Drive;
    typedef simulation::Street Street;
};

AckermannMotion withoutOffset(const AckermannMotion& motion)
{
    AckermannMotion m = motion;
    m.inverseDepthOffset.release();
    return m;
}

TEST(RSAckermann_InverseDepthOffset, points_show_it)
{
    RNG rng(36);
    double planes = 0, few = 0, many = 0;
    const int rounds = 20;
    for (int i = 0; i < rounds; i++)
    {
        const BumpyStreet street(i % 5 == 0 ? -4 : 12, 0.03, rng);
        AckermannMotion withFew = withoutOffset(street.motion), withMany = withFew;
        fitOffset(street.camera, street.bearings(250, 0.3, 0.1, rng), street.values, withFew);
        fitOffset(street.camera, street.bearings(1500, 0.3, 0.1, rng), street.values, withMany);
        ASSERT_FALSE(withFew.inverseDepthOffset.empty());
        ASSERT_LT(withFew.inverseDepthOffset.total(), withMany.inverseDepthOffset.total());
        EXPECT_GT((withMany.inverseDepthOffset.rows - 3) * (withMany.inverseDepthOffset.cols - 3), 200)
            << "five points a cell";
        planes += street.error(withoutOffset(street.motion));
        few += street.error(withFew);
        many += street.error(withMany);
        EXPECT_LT(street.error(street.motion), 1e-6);
    }
    RecordProperty("planes", format("%.3f", planes / rounds));
    RecordProperty("points_250", format("%.3f", few / rounds));
    RecordProperty("points_1500", format("%.3f", many / rounds));
    EXPECT_LT(few, 0.5 * planes);
    EXPECT_LT(many, 0.3 * planes);
}

TEST(RSAckermann_InverseDepthOffset, of_planes_is_next_to_nothing)
{
    RNG rng(37);
    for (int i = 0; i < 10; i++)
    {
        const BumpyStreet street(12, 0, rng);
        AckermannMotion found = withoutOffset(street.motion);
        fitOffset(street.camera, street.bearings(250, 0.3, 0.2, rng), street.values, found);
        EXPECT_LT(street.error(found), 0.1);
    }
}

TEST(RSAckermann_InverseDepthOffset, needs_points_and_a_way)
{
    RNG rng(38);
    const BumpyStreet street(12, 0.03, rng);
    AckermannMotion found = withoutOffset(street.motion);
    fitOffset(street.camera, street.bearings(15, 0.3, 0, rng), street.values, found);
    EXPECT_TRUE(found.inverseDepthOffset.empty());

    const std::vector<TrackedBearing> bearings = street.bearings(250, 0.3, 0, rng);
    double turning[FLOW_VALUES] = {0.3, 0, 0, 0.1, 0.1, 1, 0, 0};
    fitOffset(street.camera, bearings, turning, found);
    EXPECT_TRUE(found.inverseDepthOffset.empty());
}

TEST(RSAckermann_InverseDepthOffset, of_the_car_itself_is_none)
{
    RNG rng(39);
    const BumpyStreet street(12, 0, rng);
    AckermannMotion found = withoutOffset(street.motion), misled = found;
    std::vector<TrackedBearing> bearings = street.bearings(250, 0, 0, rng);
    fitOffset(street.camera, bearings, street.values, found);
    // The lowest part stands still.
    std::vector<PointPair> still;
    for (int i = 0; i < 80; i++)
    {
        const Point2d at = uniformPoint(rng, Point2d(0, 480), Point2d(960, 540));
        const PointPair pair = {at, at};
        still.push_back(pair);
    }
    addBearings(street.camera, still, 0.05, bearings);
    fitOffset(street.camera, bearings, street.values, misled);
    EXPECT_LT(street.error(misled), street.error(found) + 0.05);
}

}} // namespace opencv_test::
