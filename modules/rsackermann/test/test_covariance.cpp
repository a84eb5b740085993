// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_simulator.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

//! Frames and the estimator's knowledge of them.
struct Knowledge
{
    const char* name;
    int streetLines;     // segments along the street, beside 60 of which four in five are vertical lines
    double gravityNoise; // degrees, standard deviation of the errors of roll and pitch, which the estimator knows of
    double speedSigma;   // m/s, of the error of a known speed; 0: it isn't known
    double focalNoise;   // standard deviation of the relative error of the focal length, which the estimator knows of
    double delayNoise;   // the same of the line delay
};

void PrintTo(const Knowledge& knowledge, std::ostream* out)
{
    *out << knowledge.name;
}

//! The image of a line along the street on one of the planes.
bool randomStreetLine(const Simulator& simulator, const Vec3d& along, RNG& rng, Vec4d& segment)
{
    const Size size = simulator.camera.imageSize;
    const Point2d middle = uniformPoint(rng, Point2d(0, 0), Point2d(size.width - 1, size.height - 1));
    const simulation::Surface plane = simulator.surface(middle);
    Vec3d P;
    if (plane == simulation::NOTHING || !simulator.locate(middle, plane, P))
        return false;
    const Vec3d half = along * (rng.uniform(0.05, 0.2) * cv::norm(P));
    Point2d a, b;
    if (!simulator.project(P - half, a) || !simulator.project(P + half, b) || simulator.surface(a) != plane ||
        simulator.surface(b) != plane || cv::norm(a - b) < 40)
        return false;
    segment = Vec4d(a.x, a.y, b.x, b.y);
    return true;
}

Mat randomFrame(const Simulator& simulator, double wallDirection, int streetLines, RNG& rng)
{
    const double noise = 0.3;
    simulation::SegmentOptions options;
    options.inlierRatio = 0.8;
    options.noise = noise;
    Mat segments = simulation::randomSegments(simulator, options, rng).ends;
    const Vec3d along(std::sin(wallDirection), 0, std::cos(wallDirection));
    for (int tries = 0; streetLines > 0 && tries < 100000; tries++)
    {
        Vec4d segment;
        if (!randomStreetLine(simulator, along, rng, segment))
            continue;
        Mat row(1, 4, CV_64F);
        for (int j = 0; j < 4; j++)
            row.at<double>(j) = segment[j] + rng.gaussian(noise);
        segments.push_back(row);
        streetLines--;
    }
    EXPECT_EQ(0, streetLines);
    return segments;
}

//! How often the truth lies within the standard deviations of a value.
struct Coverage
{
    int known, within2, within3;

    Coverage() : known(0), within2(0), within3(0) {}

    void add(double error, double variance)
    {
        if (!(variance > 0))
            return;
        known++;
        within2 += error * error < 4 * variance;
        within3 += error * error < 9 * variance;
    }
};

class RSAckermann_Covariance : public testing::TestWithParam<Knowledge>
{
};

// For standard deviations that are those of the errors a share of 95.4 % is expected within two and 99.7 % within three
// of them. Larger ones would pass, too, if they weren't bounded: at most 99 % may lie within two.
TEST_P(RSAckermann_Covariance, is_that_of_the_errors)
{
    applyTestTag(CV_TEST_TAG_LONG);
    const Knowledge& knowledge = GetParam();
    const int frames = 1000;
    const double degree = CV_PI / 180;
    RNG rng(2018), usually(2019), cameraErrors(2020);
    Coverage coverage[4];
    for (int i = 0; i < frames; i++)
    {
        // With uncertain gravity the yaw rate is what the estimator takes for usual, and can't be tested at others.
        const double any = rng.uniform(-70., 70.),
                     usual = 5 * usually.gaussian(1) / std::sqrt(-std::log(usually.uniform(1e-6, 1.)));
        const double yawRate = (knowledge.gravityNoise > 0 ? std::min(std::max(usual, -80.), 80.) : any) * degree,
                     speed = rng.uniform(10., 140.) / 3.6;
        const double left = rng.uniform(2., 4.), right = rng.uniform(2., 4.),
                     wallDirection = rng.uniform(-3., 3.) * degree;
        RollingShutterCamera camera = simulation::paperCamera();
        const Simulator simulator = Simulator::fromMetric(camera, yawRate, speed, left, right, wallDirection);
        const Mat segments = randomFrame(simulator, wallDirection, knowledge.streetLines, rng);

        const double tilt = knowledge.gravityNoise * degree;
        const Point2d rollPitch = gaussianPoint(rng, tilt);
        camera.setRollPitch(rollPitch.x, rollPitch.y);
        const double focalScale = 1 + cameraErrors.gaussian(knowledge.focalNoise),
                     delayScale = 1 + cameraErrors.gaussian(knowledge.delayNoise);
        camera.cameraMatrix(0, 0) *= focalScale;
        camera.cameraMatrix(1, 1) *= focalScale;
        camera.focalSigma = knowledge.focalNoise * camera.cameraMatrix(0, 0);
        camera.lineDelay *= delayScale;
        camera.lineDelaySigma = knowledge.delayNoise * camera.lineDelay;
        AckermannEstimator::Params params;
        params.wallDistance = left * std::exp(rng.gaussian(params.wallDistanceLogSigma));
        params.gravitySigma = tilt;
        MotionPrior prior;
        prior.speed = speed + rng.gaussian(knowledge.speedSigma);
        prior.speedSigma = knowledge.speedSigma;
        const AckermannMotion motion = AckermannEstimator::create(camera, params)->estimate(segments, noArray(), prior);
        if (motion.status != MOTION_OK)
            continue;
        const Matx44d covariance = motion.metricCovariance(camera);
        double gotYawRate = 0, gotSpeed = 0;
        motion.yawRate(camera, gotYawRate);
        motion.speed(camera, gotSpeed);
        const double errors[4] = {gotYawRate - yawRate, gotSpeed - speed, motion.delta() - std::tan(wallDirection),
                                  motion.wallRatio - left / right};
        for (int k = 0; k < 4; k++)
            coverage[k].add(errors[k], covariance(k, k));
    }
    static const char* const names[4] = {"yaw rate", "speed", "vanishing point", "ratio of wall distances"};
    for (int k = 0; k < 4; k++)
    {
        const Coverage& c = coverage[k];
        const double share2 = double(c.within2) / c.known, share3 = double(c.within3) / c.known;
        RecordProperty(cv::format("within_2_sigma_of_value_%d", k).c_str(), cv::format("%.3f", share2).c_str());
        RecordProperty(cv::format("within_3_sigma_of_value_%d", k).c_str(), cv::format("%.3f", share3).c_str());
        EXPECT_GE(c.known, frames * 4 / 5) << names[k];
        EXPECT_GE(share2, 0.9) << names[k];
        if (k < 2)
        {
            EXPECT_LE(share2, 0.99) << names[k]; // broad priors widen those of the walls
        }
        EXPECT_GE(share3, 0.98) << names[k];
    }
}

const Knowledge knowledges[] = {{"verticals", 0, 0, 0, 0, 0},
                                {"street_lines", 40, 0, 0, 0, 0},
                                {"speed", 40, 0, 0.5, 0, 0},
                                {"focal_length_off_by_10_percent", 40, 0, 0, 0.1, 0},
                                {"line_delay_off_by_10_percent", 40, 0, 0, 0, 0.1},
                                {"gravity_off_by_1_degree", 40, 1, 0, 0, 0}};

INSTANTIATE_TEST_CASE_P(RSAckermann, RSAckermann_Covariance, testing::ValuesIn(knowledges));

// A focal length so much longer that the inclined camera would see no vertical: there is no other motion to compare
// with.
TEST(RSAckermann_CovarianceOf, a_focal_length_with_which_nothing_is_upright)
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(640, 480), 300);
    camera.lineDelay = 40e-6;
    camera.setRollPitch(0, 0.35);
    const Simulator simulator = Simulator::fromMetric(camera, 0.2, 10, 12, 12, 0);
    RNG rng(5);
    const Mat all = randomFrame(simulator, 0, 0, rng);
    Mat segments;
    for (int i = 0; i < all.rows; i++)
        if (std::abs(all.at<double>(i, 0) - 320) > 240)
            segments.push_back(all.row(i));
    AckermannEstimator::Params params;
    params.wallDistance = 12;
    params.maxSpeed = 12;
    params.maxYawRate = 0.5;
    params.slantTolerance = 0.02;
    params.gravitySigma = 0;
    const AckermannMotion exact = AckermannEstimator::create(camera, params)->estimate(segments);
    ASSERT_EQ(MOTION_OK, exact.status);
    ASSERT_GT(exact.wallRatio, 0);
    camera.focalSigma = 3 * 300;
    const AckermannMotion motion = AckermannEstimator::create(camera, params)->estimate(segments);
    EXPECT_EQ(MOTION_OK, motion.status);
    EXPECT_EQ(exact.covariance, motion.covariance);
}

// Mean absolute logarithm of the ratio of the yaw rate's standard deviations from two equivalent descriptions of
// frames.
double inequality(const RollingShutterCamera& other, double speed)
{
    RNG rng(3);
    const RollingShutterCamera camera = simulation::paperCamera();
    AckermannEstimator::Params params;
    params.reverseProbability = 0.5; // neither description is less likely
    params.priorWallDistance = 3;
    double sum = 0;
    int compared = 0;
    for (int i = 0; i < 65; i++)
    {
        const double right = rng.uniform(2., 4.), left = rng.uniform(2., 4.), yawRate = rng.uniform(-0.7, 0.7);
        const Simulator simulator = Simulator::fromMetric(camera, yawRate, speed, left, right, 0.02);
        const Mat segments = randomFrame(simulator, 0.02, 0, rng);
        Mat mirrored = segments.clone();
        for (int k = 0; k < mirrored.rows; k++)
            for (int j = 0; j < 4; j += 2)
                mirrored.at<double>(k, j) = 2 * camera.cameraMatrix(0, 2) - mirrored.at<double>(k, j);
        const AckermannMotion a = AckermannEstimator::create(camera, params)->estimate(segments);
        const AckermannMotion b = AckermannEstimator::create(other, params)->estimate(mirrored);
        if (a.status != MOTION_OK || b.status != MOTION_OK || a.model != b.model)
            continue;
        EXPECT_NEAR(std::abs(a.alpha), std::abs(b.alpha), std::sqrt(a.covariance(0, 0)));
        sum += std::abs(std::log(a.covariance(0, 0) / b.covariance(0, 0))) / 2;
        compared++;
    }
    EXPECT_GE(compared, 50);
    return sum / compared;
}

// In the mirror the walls change places.
TEST(RSAckermann_CovarianceOfEquivalents, mirrored_street)
{
    EXPECT_LT(inequality(simulation::paperCamera(), 15), 0.05);
}

// Rows read from below are those of a drive backward in time, whose forward direction is behind the camera: azimuths
// near half a turn.
TEST(RSAckermann_CovarianceOfEquivalents, rear_camera)
{
    RollingShutterCamera rear = simulation::paperCamera();
    rear.scanDirection = SCAN_BOTTOM_TO_TOP;
    rear.referenceRow = rear.imageSize.height - 1 - rear.referenceRow;
    rear.heading = CV_PI;
    EXPECT_LT(inequality(rear, 15), 0.02);
}

}} // namespace opencv_test::
