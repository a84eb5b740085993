// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_inverse_depth_offset.hpp"
#include "test_simulator.hpp"
#include "../src/camera/axis_rotations.hpp"
#include "../src/sequence/scene_fit.hpp"

// Scenes that deviate from their planes: how tracked points show them, and the scale of a given depth.

namespace opencv_test { namespace {

using simulation::Simulator;

//! A drive past things that stand before and behind the planes of its street.
struct BumpyStreet
{
    RollingShutterCamera camera;
    AckermannMotion motion; // with the true offset
    Simulator simulator;
    double values[FLOW_VALUES];

    //! @param tilt of the car, about both axes, which the motion has found.
    BumpyStreet(double speed, double deviation, RNG& rng, double tilt = 0, double referenceRow = 269.5)
        : camera(Size(960, 540), Matx33d(700, 0, 470, 0, 840, 280, 0, 0, 1)), simulator(camera, Drive(), Street()),
          values()
    {
        camera.lineDelay = 0.03 / 540;
        camera.height = 1.3;
        camera.heading = 0.05;
        camera.referenceRow = referenceRow;
        camera.setRollPitch(0.01, 0.04);
        const double yawRate = rng.uniform(-0.3, 0.3), unit = camera.secondsPerUnitTime();
        simulator = Simulator::fromMetric(camera, yawRate, speed, 6, 9, 0.1);
        SequenceState state(camera, AckermannEstimator::Params());
        const double known[] = {yawRate, speed, 0.1, 1 / 6., 1 / 9., 1 / 1.3, tilt, tilt};
        camera.uprightRotation = tiltRotation(tilt, tilt).t() * camera.uprightRotation;
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

    //! Inverse depths of what the raw image shows, 1/m along the optical axis, in squares; NaN where nothing fell.
    Mat1f inverseDepths(int step = 8) const
    {
        Mat1f inverse(camera.imageSize, std::numeric_limits<float>::quiet_NaN());
        for (int y = -40; y < 580; y += step)
            for (int x = -60; x < 1020; x += step)
            {
                Vec3d P;
                Point2d raw;
                if (!pointAt(Point2d(x, y), P) || !simulator.project(P, raw))
                    continue;
                const Vec3d inRow = simulator.drive.toCamera(P, simulator.time(raw));
                const int half = step / 2 + 1;
                const Rect square(cvRound(raw.x) - half, cvRound(raw.y) - half, 2 * half, 2 * half);
                inverse(square & Rect(Point(), inverse.size())) = 1 / (motion.uprightRotation(camera).t() * inRow)[2];
            }
        return inverse;
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

    //! From which still points come, as bearings.
    Point2d focusOfExpansion() const { return Point2d(std::tan(camera.heading), 0); }

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
        const double tilt = i % 2 ? 0.03 : 0; // found by the fit
        const BumpyStreet street(i % 5 == 0 ? -4 : 12, 0.03, rng, tilt);
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

// What moves across the way of still points says nothing of depths, however it moves along it.
TEST(RSAckermann_InverseDepthOffset, what_moves_shows_none)
{
    RNG rng(43);
    double clean = 0, disturbed = 0;
    for (int i = 0; i < 4; i++)
    {
        const BumpyStreet street(12, 0, rng);
        std::vector<TrackedBearing> bearings = street.bearings(600, 0.1, 0, rng);
        AckermannMotion without = withoutOffset(street.motion), with = without;
        fitOffset(street.camera, bearings, street.values, without);
        const Point2d epipole = street.focusOfExpansion();
        for (size_t k = 0; k < bearings.size(); k += 2)
        {
            const Point2d way = bearings[k].now - epipole, ahead = way / cv::norm(way), aside(-ahead.y, ahead.x);
            bearings[k].other += (2 * ahead + 8 * aside) / street.camera.cameraMatrix(0, 0);
        }
        fitOffset(street.camera, bearings, street.values, with);
        clean += street.error(without);
        disturbed += street.error(with);
    }
    EXPECT_LT(disturbed, 5 * clean);
}

// However few they are, and however far away, points make it better than the planes are, with a cell for five of them.
TEST(RSAckermann_InverseDepthOffset, few_points_and_far_ones)
{
    RNG rng(42);
    for (const int count : {25, 60, 200})
        for (const bool isFar : {false, true})
        {
            SCOPED_TRACE(testing::Message() << count << " " << isFar);
            double planes = 0, found = 0;
            for (int i = 0; i < 4; i++)
            {
                const BumpyStreet street(12, 0.03, rng);
                std::vector<TrackedBearing> bearings = street.bearings(3 * count, 0.2, 0, rng);
                const double far = 0.12; // from the horizon
                bearings.erase(
                    std::remove_if(bearings.begin(), bearings.end(),
                                   [&](const TrackedBearing& b) { return isFar && std::abs(b.now.y) > far; }),
                    bearings.end());
                bearings.resize(std::min(bearings.size(), size_t(count)));
                AckermannMotion motion = withoutOffset(street.motion);
                planes += street.error(motion);
                fitOffset(street.camera, bearings, street.values, motion);
                ASSERT_FALSE(motion.inverseDepthOffset.empty());
                const int cells = (motion.inverseDepthOffset.rows - 3) * (motion.inverseDepthOffset.cols - 3);
                EXPECT_NEAR(bearings.size() / 5., cells, 0.3 * bearings.size() / 5 + 2);
                found += street.error(motion);
            }
            EXPECT_LT(found, (count < 100 ? 0.95 : 0.8) * planes);
        }
}

// Neither a part of it nor more would be better: what points hardly show is weighed with what is usual.
TEST(RSAckermann_InverseDepthOffset, is_neither_too_small_nor_too_large)
{
    RNG rng(43);
    const double parts[] = {0.8, 1, 1.25};
    double errors[3] = {0, 0, 0};
    for (int i = 0; i < 10; i++)
    {
        const BumpyStreet street(i % 5 == 0 ? -4 : 12, 0.03, rng);
        AckermannMotion motion = withoutOffset(street.motion);
        fitOffset(street.camera, street.bearings(80, 0.3, 0, rng), street.values, motion);
        const Mat offset = motion.inverseDepthOffset.clone();
        for (int k = 0; k < 3; k++)
        {
            motion.inverseDepthOffset = parts[k] * offset;
            errors[k] += street.error(motion);
        }
    }
    EXPECT_LT(errors[1], errors[0]);
    EXPECT_LT(errors[1], errors[2]);
}

// Also if the car leans, so that the planes of the fit are others, and whichever row is the reference.
TEST(RSAckermann_InverseDepthOffset, of_planes_is_next_to_nothing)
{
    RNG rng(37);
    for (const double speed : {12., -6.})
        for (const double tilt : {-0.01, 0., 0.01})
            for (const double reference : {0., 269.5, 539.})
            {
                SCOPED_TRACE(testing::Message() << speed << " " << tilt << " " << reference);
                double error = 0;
                const int rounds = 4;
                for (int i = 0; i < rounds; i++)
                {
                    const BumpyStreet street(speed, 0, rng, tilt, reference);
                    AckermannMotion found = withoutOffset(street.motion);
                    fitOffset(street.camera, street.bearings(250, 0.3, 0.2, rng), street.values, found);
                    error += street.error(found) / rounds;
                }
                EXPECT_LT(error, tilt == 0 ? 0.05 : 0.15);
            }
}

// Whichever row is the reference, between which and a point's row a fast car has come nearer.
TEST(RSAckermann_InverseDepthOffset, many_points_show_nearly_all_of_it)
{
    RNG rng(44);
    for (const double reference : {0., 269.5, 539.})
    {
        SCOPED_TRACE(reference);
        double planes = 0, left = 0;
        for (int i = 0; i < 4; i++)
        {
            const BumpyStreet street(25, 0.03, rng, 0, reference);
            AckermannMotion found = withoutOffset(street.motion);
            planes += street.error(found);
            fitOffset(street.camera, street.bearings(2000, 0.05, 0.1, rng), street.values, found);
            left += street.error(found);
        }
        EXPECT_LT(left, 0.05 * planes);
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
    ASSERT_EQ(found.inverseDepthOffset.size(), misled.inverseDepthOffset.size());
    EXPECT_EQ(0, cv::norm(found.inverseDepthOffset, misled.inverseDepthOffset, NORM_INF));
}

//! That of a frame whose points show the motion.
SequenceFit fitOf(const BumpyStreet& street)
{
    SequenceFit fit(SequenceState(street.camera, AckermannEstimator::Params()));
    std::copy(street.values, street.values + FLOW_VALUES, fit.values);
    return fit;
}

//! As networks give it.
DepthMap relativeOf(const Mat1f& inverse, RNG& rng)
{
    return DepthMap(std::exp(rng.gaussian(2)) * inverse + rng.gaussian(3), DEPTH_RAW, 1, DEPTH_RELATIVE);
}

TEST(RSAckermann_DepthFit, points_show_scale_and_shift)
{
    RNG rng(40);
    for (int i = 0; i < 6; i++)
    {
        const double tilt = i % 2 ? 0.35 : 0; // found by the fit
        const BumpyStreet street(i % 3 == 0 ? -4 : 12, 0.03, rng, tilt);
        const Mat1f inverse = street.inverseDepths();
        DepthMap depth = relativeOf(inverse, rng);
        DepthFit found;
        ASSERT_TRUE(fitDepth(street.camera, street.bearings(250, 0.3, 0.2, rng), fitOf(street),
                             withoutOffset(street.motion), depth, found))
            << i;
        const double way = std::abs(street.values[SEQUENCE_SPEED]) * street.camera.secondsPerUnitTime();
        const Mat1f error = depth.scale * Mat1f(depth.values) + depth.shift - way * inverse;
        const Mat known = inverse == inverse;
        EXPECT_LT(cv::norm(error, NORM_L1, known), 0.05 * way * cv::norm(inverse, NORM_L1, known)) << i;
        EXPECT_LT(found.residual, 0.1) << i;
    }
}

// Planes that aren't where they seem to be mislead the turns; a depth doesn't. What is known before counts as well.
TEST(RSAckermann_DepthFit, points_show_the_yaw_rate)
{
    RNG rng(42);
    const double wrong = 0.05;
    for (int i = 0; i < 6; i++)
    {
        const BumpyStreet street(12, 0.03, rng);
        const Mat1f inverse = street.inverseDepths();
        DepthMap depth = relativeOf(inverse, rng);
        const double way = street.values[SEQUENCE_SPEED] * street.camera.secondsPerUnitTime();
        SequenceFit planes = fitOf(street);
        planes.values[SEQUENCE_YAW_RATE] += wrong;
        const std::vector<TrackedBearing> bearings = street.bearings(250, 0.3, 0.1, rng);
        DepthFit found;
        ASSERT_TRUE(fitDepth(street.camera, bearings, planes, withoutOffset(street.motion), depth, found)) << i;
        const double sigma = std::sqrt(found.covariance(0, 0));
        EXPECT_NEAR(street.values[SEQUENCE_YAW_RATE], found.yawRate, 0.3 * wrong) << i;
        EXPECT_NEAR(street.values[SEQUENCE_YAW_RATE], found.yawRate, 3 * sigma) << i;
        // Scale and shift err together: what they say of a place in between is known well.
        const double middle = (way / 10 - depth.shift) / depth.scale;
        const Vec3d J(0, middle, 1);
        EXPECT_LT(std::sqrt(J.dot(found.covariance * J)), 0.05 * way / 10) << i;

        const double expected = street.values[SEQUENCE_YAW_RATE] + 0.003;
        planes.prediction.value[SEQUENCE_YAW_RATE] = expected;
        planes.prediction.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE) = 1e-8;
        ASSERT_TRUE(fitDepth(street.camera, bearings, planes, withoutOffset(street.motion), depth, found)) << i;
        EXPECT_NEAR(expected, found.yawRate, 3e-4) << i;
        EXPECT_LE(std::sqrt(found.covariance(0, 0)), 1e-4) << i;
    }
}

TEST(RSAckermann_DepthFit, refuses_what_points_contradict)
{
    RNG rng(41);
    const BumpyStreet street(12, 0.05, rng), other(12, 0.05, rng);
    const std::vector<TrackedBearing> bearings = street.bearings(250, 0.3, 0.1, rng);
    const AckermannMotion planes = withoutOffset(street.motion);
    const SequenceFit fit = fitOf(street);
    const Mat1f inverse = street.inverseDepths(), ofOther = other.inverseDepths();
    Mat mirrored, whole;
    flip(inverse, mirrored, 1);
    DepthFit found;
    for (const Mat& values : {mirrored, Mat(ofOther), Mat(-inverse), Mat(Mat1f(inverse.size(), 3.f))})
    {
        DepthMap depth(values, DEPTH_RAW, 1, DEPTH_RELATIVE);
        EXPECT_FALSE(fitDepth(street.camera, bearings, fit, planes, depth, found));
        EXPECT_EQ(1, depth.scale);
        EXPECT_EQ(0, depth.shift);
    }
    DepthMap depth(inverse, DEPTH_RAW, 1, DEPTH_RELATIVE);
    EXPECT_FALSE(fitDepth(street.camera, street.bearings(15, 0.3, 0, rng), fit, planes, depth, found));
    inverse.convertTo(whole, CV_16U, 60000);
    for (const Mat& values : {Mat(inverse), whole})
    {
        depth = DepthMap(values, DEPTH_RAW, 1, DEPTH_RELATIVE);
        EXPECT_TRUE(fitDepth(street.camera, bearings, fit, planes, depth, found));
    }
}

// The metres of the motion are those of a depth as surely as they are known: what differs by a few standard deviations
// is changed to what the points show, and what differs by more, or is mirrored, isn't used.
TEST(RSAckermann_DepthFit, metres)
{
    RNG rng(44);
    for (int i = 0; i < 6; i++)
    {
        const double speed = i % 3 == 0 ? -4 : 12;
        const BumpyStreet street(speed, 0.02, rng);
        const Mat1f inverse = street.inverseDepths();
        const std::vector<TrackedBearing> bearings = street.bearings(250, 0.3, 0.1, rng);
        AckermannMotion planes = withoutOffset(street.motion);
        planes.scale = SCALE_SPEED;
        planes.wallDistance = 6;
        Mat mirrored;
        flip(inverse, mirrored, 1);
        for (const double sigma : {0.02, 0.1})
        {
            planes.speedSigma = sigma * std::abs(speed);
            for (const double factor : {1., 1 + sigma, 1 - sigma, 3., 1 / 3.})
            {
                SCOPED_TRACE(testing::Message() << i << " " << sigma << " " << factor);
                const bool isClose = std::abs(factor - 1) < 0.2;
                DepthMap depth(factor / inverse, DEPTH_RAW, 0.5), reference(1 / mirrored);
                depth.values *= 2;
                DepthFit found;
                EXPECT_EQ(isClose, fitDepth(street.camera, bearings, fitOf(street), planes, depth, found));
                EXPECT_FALSE(fitDepth(street.camera, bearings, fitOf(street), planes, reference, found));
                EXPECT_EQ(1, reference.scale);
                EXPECT_EQ(0, depth.shift);
                if (!isClose)
                    EXPECT_EQ(0.5, depth.scale);
                else
                    EXPECT_NEAR(0.5 / factor, depth.scale, 0.02);
            }
        }
        planes.scale = SCALE_UNKNOWN;
        planes.wallDistance = 0;
        DepthMap depth(1 / inverse);
        DepthFit found;
        EXPECT_FALSE(fitDepth(street.camera, bearings, fitOf(street), planes, depth, found));
    }
}

// Where the planes explain the points as well a depth is used all the same: it knows what no point shows.
TEST(RSAckermann_DepthFit, is_used_where_planes_hold)
{
    RNG rng(43);
    for (int i = 0; i < 6; i++)
    {
        const BumpyStreet street(12, 0, rng);
        DepthMap depth = relativeOf(street.inverseDepths(4), rng);
        DepthFit found;
        EXPECT_TRUE(fitDepth(street.camera, street.bearings(400, 0.3, 0, rng), fitOf(street),
                             withoutOffset(street.motion), depth, found))
            << i;
    }
}

}} // namespace opencv_test::
