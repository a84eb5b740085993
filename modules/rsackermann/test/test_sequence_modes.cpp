// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_symmetry.hpp"
#include "test_simulator.hpp"
#include "opencv2/rsackermann/corrector.hpp"
#include <functional>

// Sequences of images of a street in each mode: the truth, and what a mirror shows.

namespace opencv_test { namespace {

using simulation::Simulator;

const double INTERVAL = 0.05;
const int FRAMES = 4;
const double GYRO_END = 0.9; // seconds until which there are samples

struct Setting
{
    RollingShutterCamera camera;
    MetricMotion metric;
    RollingShutterCorrector::Params params;
    double shaking = 0;   // radians, of the camera's roll and pitch
    double yawChange = 0; // rad/s^2
    int bonnet = 0;       // rows at the lower end of the image
    double light = 1;     // of every second frame

    //! Whether what is seen in a frame may be found some frames later (README, "Limits").
    bool reaches(int later) const { return std::abs(metric.speed) * later * INTERVAL < 4; }

    //! Of roll, pitch and yaw, seconds after the first frame.
    Vec3d shakenAt(double seconds) const { return shaking * Vec3d(std::sin(13 * seconds), -std::sin(17 * seconds), 0); }
    Vec3d shakingAt(double seconds) const
    {
        return shaking * Vec3d(13 * std::cos(13 * seconds), -17 * std::cos(17 * seconds), 0);
    }
};

struct Mode
{
    const char* name;
    std::function<void(Setting&)> make;
};

const Mode MODES[] = {{"forward", [](Setting&) {}},
                      {"reverse", [](Setting& s) { s.metric.speed = -7; }},
                      {"left turn", [](Setting& s) { s.metric.yawRate = -0.4; }},
                      {"left wall", [](Setting& s) { s.metric.rightDistance = 0; }},
                      {"right wall", [](Setting& s) { s.metric.leftDistance = 0; }},
                      {"right wall in reverse",
                       [](Setting& s) {
                           s.metric.leftDistance = 0;
                           s.metric.speed = -7;
                       }},
                      {"looks half right",
                       [](Setting& s) {
                           s.camera.heading = -0.8;
                           s.metric.wallDirection = -0.75;
                       }},
                      {"from below", [](Setting& s) { s.camera.scanDirection = SCAN_BOTTOM_TO_TOP; }},
                      {"shakes", [](Setting& s) { s.shaking = 0.004; }},
                      {"weaves", [](Setting& s) { s.yawChange = -1.5; }},
                      {"large images",
                       [](Setting& s) {
                           s.metric.speed = 7; // at each frame most points are within reach
                           s.camera.imageSize = Size(1152, 720);
                           s.camera.cameraMatrix = Matx33d(900, 0, 555, 0, 930, 345, 0, 0, 1);
                           s.camera.lineDelay /= 3;
                           s.camera.referenceRow *= 3;
                       }},
                      {"motorway",
                       [](Setting& s) {
                           s.metric.speed = 27;
                           s.metric.yawRate = 0.1;
                           s.metric.leftDistance = 6;
                           s.metric.rightDistance = 7;
                       }},
                      {"bonnet", [](Setting& s) { s.bonnet = 60; }},
                      {"light changes", [](Setting& s) { s.light = 0.75; }},
                      {"gravity is known", [](Setting& s) { s.params.estimator.gravitySigma = 0; }}};

Setting settingOf(const Mode& mode)
{
    Setting s;
    s.camera = RollingShutterCamera(Size(384, 240), Matx33d(300, 0, 185, 0, 310, 115, 0, 0, 1));
    s.camera.lineDelay = 0.03 / 240;
    s.camera.referenceRow = 100;
    s.camera.height = 1.3;
    s.camera.heading = 0.05;
    s.camera.headingSigma = 0;
    s.camera.setRollPitch(0.02, 0.05);
    s.metric.yawRate = 0.3;
    s.metric.speed = 9;
    s.metric.leftDistance = 4;
    s.metric.rightDistance = 5;
    s.metric.wallDirection = 0.08;
    s.params.sequence = true;
    s.params.frameInterval = INTERVAL;
    s.params.estimator.gravitySigma = 0.005;
    s.params.estimator.scaleFromRoad = true;
    mode.make(s);
    return s;
}

//! Images of walls and a road that have a texture, row by row.
class StreetImages
{
public:
    explicit StreetImages(const Setting& s)
        : simulator(Simulator::fromMetric(s.camera, s.metric.yawRate, s.metric.speed, s.metric.leftDistance,
                                          s.metric.rightDistance, s.metric.wallDirection)),
          setting(s), interval(INTERVAL / s.camera.secondsPerUnitTime()), direction(s.metric.wallDirection)
    {
        const double unit = s.camera.secondsPerUnitTime();
        simulator.drive.yawChange = s.yawChange * unit * unit;
        simulator.drive.shaking = [=](double t) { return setting.shakenAt(t * unit); };
        RNG rng(2);
        Mat fine(1024, 1024, CV_32F), coarse(128, 128, CV_32F), grown;
        rng.fill(fine, RNG::NORMAL, 0, 1);
        rng.fill(coarse, RNG::NORMAL, 0, 1);
        GaussianBlur(fine, fine, Size(), 2);
        resize(coarse, grown, fine.size(), 0, 0, INTER_CUBIC);
        texture = fine * 4 + grown;
        normalize(texture, texture, 10, 245, NORM_MINMAX, CV_8U);
    }

    Mat frame(int i) const
    {
        const RollingShutterCamera& camera = simulator.camera;
        Mat map(camera.imageSize, CV_32FC2), image;
        for (int y = 0; y < map.rows; y++)
        {
            const double t = simulator.time(Point2d(0, y)) + i * interval;
            const Vec3d place = simulator.drive.position(t);
            for (int x = 0; x < map.cols; x++)
            {
                const Vec3d ray = simulator.drive.turn(simulator.bearing(Point2d(x, y)), t);
                map.at<Point2f>(y, x) = patternAt(place, ray);
            }
        }
        remap(texture, image, map, noArray(), INTER_LINEAR, BORDER_WRAP);
        const Rect ofCar(0, image.rows - setting.bonnet, image.cols, setting.bonnet);
        if (!ofCar.empty())
            texture(ofCar).copyTo(image(ofCar));
        if (i % 2)
            image *= setting.light;
        return image;
    }

    //! Along the optical axis, 1/m.
    Mat1f inverseDepth(int i) const
    {
        const RollingShutterCamera& camera = simulator.camera;
        Mat1f inverse(camera.imageSize, 0.f);
        for (int y = 0; y < inverse.rows; y++)
        {
            const double t = simulator.time(Point2d(0, y)) + i * interval;
            const Vec3d place = simulator.drive.position(t);
            for (int x = 0; x < inverse.cols; x++)
            {
                const Vec3d bearing = simulator.bearing(Point2d(x, y)), ray = simulator.drive.turn(bearing, t);
                const simulation::Surface surface = simulator.street.first(place, ray);
                if (surface != simulation::NOTHING)
                    inverse(y, x) = float(1 / (simulator.street.distance(surface, place, ray) *
                                               (camera.uprightRotation.t() * bearing)[2]));
            }
        }
        return inverse;
    }

    //! As the motion of a frame has it.
    AckermannMotion truth(const Setting& s, int i) const
    {
        const double t = i * interval, yaw = simulator.drive.turned(t);
        const Vec3d place = simulator.drive.position(t), right(std::cos(direction), 0, -std::sin(direction));
        MetricMotion m = s.metric;
        m.wallDirection -= yaw;
        m.yawRate += s.yawChange * i * INTERVAL;
        const double moved = place.dot(right);
        m.leftDistance = m.leftDistance > 0 ? m.leftDistance + moved : 0;
        m.rightDistance = m.rightDistance > 0 ? m.rightDistance - moved : 0;
        AckermannMotion motion = AckermannMotion::fromMetric(s.camera, m);
        const Vec3d shaken = s.shakenAt(i * INTERVAL), rate = s.shakingAt(i * INTERVAL) * s.camera.secondsPerUnitTime();
        motion.rollCorrection = shaken[0];
        motion.pitchCorrection = shaken[1];
        motion.rollRate = rate[0];
        motion.pitchRate = rate[1];
        return motion;
    }

private:
    Point2f patternAt(const Vec3d& place, const Vec3d& ray) const
    {
        const simulation::Surface surface = simulator.street.first(place, ray);
        if (surface == simulation::NOTHING) // what is far away on a side without a wall
        {
            const double perRadian = simulator.camera.cameraMatrix(0, 0);
            return Point2f(float(perRadian * std::atan2(ray[0], ray[2])), float(perRadian * ray[1]));
        }
        const double perMetre = 40;
        const Vec3d P = place + ray * simulator.street.distance(surface, place, ray),
                    along(std::sin(direction), 0, std::cos(direction)),
                    across(std::cos(direction), 0, -std::sin(direction));
        const double other = surface == simulation::ROAD ? P.dot(across) : P[1];
        return Point2f(float(perMetre * P.dot(along)), float(perMetre * other + 300 * surface));
    }

    Simulator simulator;
    const Setting setting;
    const double interval, direction;
    Mat texture;
};

//! What is known beside the frames.
enum Source { NOTHING, NEXT_FRAME, GYRO, GIVEN, SOURCES };
const char* const NAMES[] = {"nothing", "next frame", "gyro", "given"};

Ptr<RollingShutterCorrector> createCorrector(const Setting& s, const Twin& twin, int source)
{
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(twin.of(s.camera), s.params);
    if (source == GIVEN)
    {
        MotionPrior prior;
        prior.speed = s.metric.speed;
        prior.speedSigma = 0.3;
        prior.yawRate = s.metric.yawRate;
        prior.yawRateSigma = 0.02;
        corrector->setPrior(twin.of(prior));
    }
    if (source != GYRO)
        return corrector;
    Mat times, rates;
    for (double t = -0.2; t < GYRO_END + 0.1; t += 0.004)
    {
        const Vec3d shaken = s.shakingAt(t);
        times.push_back(t);
        const Vec3d rate =
            s.camera.uprightRotation.t() * Vec3d(-shaken[1], s.metric.yawRate + s.yawChange * t, shaken[0]);
        rates.push_back(Mat(twin.ofRates(rate).t()));
    }
    corrector->addGyro(times, rates);
    return corrector;
}

AckermannMotion correctFrame(RollingShutterCorrector& corrector, const std::vector<Mat>& frames, int i, int source,
                             const Twin& twin = Twin(), const DepthMap& depth = DepthMap())
{
    Mat corrected;
    corrector.setTimestamp(i * INTERVAL);
    if (source == NEXT_FRAME && i + 1 < int(frames.size()))
        corrector.setNextFrame(twin.ofImage(frames[i + 1]), (i + 1) * INTERVAL);
    return corrector.correct(twin.ofImage(frames[i]), corrected, noArray(), depth);
}

struct SequenceModes : testing::TestWithParam<int> // index of MODES
{
    SequenceModes() : setting(settingOf(MODES[GetParam()])), street(setting)
    {
        for (int i = 0; i < FRAMES; i++)
            frames.push_back(street.frame(i));
    }

    const Setting setting;
    const StreetImages street;
    std::vector<Mat> frames;
};

void expectTruth(const Setting& s, const RollingShutterCamera& camera, const AckermannMotion& truth,
                 const AckermannMotion& m, int source)
{
    ASSERT_EQ(MOTION_OK, m.status);
    EXPECT_GT(m.direction * s.metric.speed, 0);
    EXPECT_FALSE(m.contradictsPrior);
    const Simulator exact = Simulator::fromMotion(camera, truth);
    const double unit = camera.secondsPerUnitTime(), raw = exact.meanDisplacement();
    EXPECT_LT(exact.meanDisplacement(Simulator::fromMotion(camera, m)), (s.shaking > 0 ? 0.2 : 0.06) * raw);
    double speed, trueSpeed;
    EXPECT_TRUE(m.speed(camera, speed));
    truth.speed(camera, trueSpeed);
    // Of a road whose tilt changes from frame to frame less is known.
    EXPECT_NEAR(trueSpeed, speed, (s.shaking > 0 ? 0.05 : 0.04) * std::abs(trueSpeed));
    EXPECT_NEAR(std::abs(speed) * unit, m.wallDistance * std::hypot(m.wallSlope, m.wallOffset),
                0.04 * std::abs(speed) * unit);
    EXPECT_FALSE(m.rollYawAmbiguous); // many frames tell them apart
    EXPECT_NEAR(truth.alpha, m.alpha, 0.02 * unit / 2);
    EXPECT_NEAR(truth.alpha, m.alpha, 3 * std::sqrt(m.covariance(0, 0)));
    EXPECT_NEAR(truth.roadSlope, m.roadSlope, 0.04 * std::abs(truth.roadSlope));
    if (source == GYRO)
    {
        EXPECT_NEAR(truth.pitchRate, m.pitchRate, std::max(0.01 * unit, 2 * m.pitchRateSigma));
        EXPECT_NEAR(truth.rollRate, m.rollRate, std::max(0.01 * unit, 2 * m.rollRateSigma));
    }
    if (source == GIVEN)
    {
        EXPECT_NEAR(2 * truth.alpha / unit, m.seenYawRate, 3 * m.seenYawRateSigma);
        EXPECT_NEAR(trueSpeed, m.seenSpeed, 3 * m.seenSpeedSigma);
    }
    else // there is nothing to compare it with
        for (const double seen : {m.seenYawRate, m.seenYawRateSigma, m.seenSpeed, m.seenSpeedSigma})
            EXPECT_EQ(0, seen);
    if (!m.inverseDepthOffset.empty())
    {
        // Its cells are nearly squares.
        const double width = m.offsetArea.width / (m.inverseDepthOffset.cols - 3),
                     height = m.offsetArea.height / (m.inverseDepthOffset.rows - 3);
        EXPECT_LT(std::abs(std::log(width / height)), 0.4);
    }
}

TEST_P(SequenceModes, truth_and_mirror)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    for (int source = 0; source < SOURCES; source++)
        for (const Twin& twin : {Twin(), MIRRORED_ON_ITS_HEAD})
        {
            if (setting.yawChange != 0 && source != GYRO)
                continue; // others see a mean
            const RollingShutterCamera camera = twin.of(setting.camera);
            const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, twin, source);
            for (int i = 0; i < FRAMES; i++)
            {
                const AckermannMotion m = correctFrame(*corrector, frames, i, source, twin);
                SCOPED_TRACE(testing::Message() << NAMES[source] << " " << twin << " " << i);
                if (i > 1)
                    expectTruth(setting, camera, twin.of(street.truth(setting, i), setting.camera), m, source);
            }
        }
}

// A camera of which it isn't known where it looks: the frames show it, and the motion that goes with it. Given as exact
// it is shown all the same.
TEST_P(SequenceModes, heading_that_is_not_known)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    if (setting.yawChange != 0)
        return;
    Setting given = setting;
    given.camera.heading += 0.035;
    for (const double sigma : {0.09, 0.})
        for (const Twin& twin : {Twin(), MIRRORED_ON_ITS_HEAD})
        {
            const bool isExact = sigma == 0;
            given.camera.headingSigma = sigma;
            const RollingShutterCamera camera = twin.of(setting.camera), other = twin.of(given.camera);
            const Ptr<RollingShutterCorrector> corrector = createCorrector(given, twin, NOTHING);
            AckermannMotion m;
            for (int i = 0; i < FRAMES; i++)
            {
                m = correctFrame(*corrector, frames, i, NOTHING, twin);
                SCOPED_TRACE(testing::Message() << twin << " " << isExact << " " << i);
                EXPECT_TRUE(m.readoutRatioSigma > 0 || m.readoutRatio == 1) << m.readoutRatio;
                // From the second one on, of which the heading is known from itself alone.
                const AckermannMotion truth = twin.of(street.truth(setting, i), setting.camera);
                const Simulator exact = Simulator::fromMotion(camera, truth);
                if (i > 0 && !isExact)
                {
                    EXPECT_NEAR(truth.alpha, m.alpha, 3 * std::sqrt(m.covariance(0, 0)));
                    EXPECT_LT(exact.meanDisplacement(Simulator::fromMotion(camera, m)), 0.2 * exact.meanDisplacement());
                }
            }
            SCOPED_TRACE(testing::Message() << twin << " " << isExact);
            EXPECT_GT(m.seenHeadingSigma, 0);
            EXPECT_NEAR(camera.heading, m.seenHeading, 3 * m.seenHeadingSigma);
            EXPECT_LT(m.seenHeadingSigma, 0.03);
            EXPECT_EQ(other.heading + m.headingCorrection, m.heading(other));
            if (isExact)
                continue; // in a bend it may be the camera's place
            EXPECT_NEAR(camera.heading, m.heading(other), 0.015);
            expectTruth(setting, camera, twin.of(street.truth(setting, FRAMES - 1), setting.camera), m, NOTHING);
        }
}

TEST_P(SequenceModes, the_same_camera_and_parameters_again)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    Setting given = setting;
    given.camera.heading += 0.035; // by which it is turned, and then knows of a lever
    given.camera.headingSigma = 0.09;
    const Ptr<RollingShutterCorrector> once = createCorrector(given, Twin(), NOTHING),
                                       again = createCorrector(given, Twin(), NOTHING);
    for (int i = 0; i < FRAMES; i++)
    {
        const AckermannMotion first = correctFrame(*once, frames, i, NOTHING, Twin()),
                              second = correctFrame(*again, frames, i, NOTHING, Twin());
        EXPECT_EQ(first.alpha, second.alpha) << i;
        EXPECT_EQ(0, cv::norm(first.covariance - second.covariance)) << i;
        again->setCamera(again->getCamera());
        again->setParams(again->getParams());
    }
}

// The yaw rate of the frame that shows the heading goes with it.
TEST(RSAckermann_SequenceModes, heading_of_the_first_frame)
{
    Setting setting = settingOf(MODES[0]);
    setting.metric.yawRate = 0;
    const StreetImages street(setting);
    const std::vector<Mat> frames = {street.frame(0), street.frame(1)};
    const auto yawRateOf = [&](double error, double sigma) {
        Setting given = setting;
        given.camera.heading += error;
        given.camera.headingSigma = sigma;
        const Ptr<RollingShutterCorrector> corrector = createCorrector(given, Twin(), NOTHING);
        double yawRate = 0;
        for (int i = 0; i < 2; i++)
            correctFrame(*corrector, frames, i, NOTHING).yawRate(given.camera, yawRate);
        return yawRate;
    };
    const double known = yawRateOf(0, 0), wrong = yawRateOf(0.035, 0), found = yawRateOf(0.035, 0.09);
    EXPECT_GT(std::abs(wrong - known), 0.003);
    EXPECT_LT(std::abs(found - known), 0.4 * std::abs(wrong - known));
}

// Points are looked for where what is known of motion and scene expects them, if the car has gone far meanwhile.
TEST_P(SequenceModes, frames_that_are_missing)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    if (setting.yawChange != 0 || setting.light != 1 || !setting.reaches(3))
        return; // a mean is seen, and little if the light changes meanwhile
    const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), NOTHING);
    for (int i = 0; i < FRAMES; i++)
        correctFrame(*corrector, frames, i, NOTHING);
    const int later = FRAMES + 2;
    Mat corrected;
    corrector->setTimestamp(later * INTERVAL);
    const AckermannMotion m = corrector->correct(street.frame(later), corrected);
    EXPECT_TRUE(corrector->isTracked());
    expectTruth(setting, setting.camera, street.truth(setting, later), m, NOTHING);
}

// Nor have the first frames to be near each other: the few points that are found show where the others are.
TEST_P(SequenceModes, first_frames_far_apart)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    if (setting.yawChange != 0 || setting.light != 1 || setting.bonnet > 0)
        return; // most of what is found at once may be the bonnet
    // 1.8 m, or 1.4 on a motorway; what shakes has turned half round after 0.2 s, and shows nothing (README, "Limits")
    const int far = setting.shaking > 0 ? 2 : 4, step = setting.reaches(far) ? far : 1;
    const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), NOTHING);
    Mat corrected;
    for (int i = 0; i < 3; i++)
    {
        SCOPED_TRACE(i);
        corrector->setTimestamp(i * step * INTERVAL);
        const AckermannMotion m = corrector->correct(street.frame(i * step), corrected);
        EXPECT_EQ(i > 0, corrector->isTracked());
        if (i == 0)
            continue;
        const AckermannMotion truth = street.truth(setting, i * step);
        const Simulator exact = Simulator::fromMotion(setting.camera, truth);
        const double left = exact.meanDisplacement(Simulator::fromMotion(setting.camera, m)),
                     raw = exact.meanDisplacement();
        RecordProperty("left", format("%.2f of %.2f, expected %.2f", left, raw, m.expectedResidual));
        EXPECT_LT(left, (setting.shaking > 0 ? 0.25 : 0.1) * raw);
        EXPECT_LT(left, 2 * m.expectedResidual);
        EXPECT_NEAR(truth.alpha, m.alpha, 3 * std::sqrt(m.covariance(0, 0)));
        EXPECT_NEAR(truth.roadSlope, m.roadSlope, 0.15 * std::abs(truth.roadSlope));
    }
}

// The frame after one that is damaged is as good as others: its points are those of the frame before that.
TEST_P(SequenceModes, frames_that_are_damaged)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    if (setting.yawChange != 0)
        return; // a mean is seen
    Mat noise(setting.camera.imageSize, CV_8U), corrected;
    theRNG().state = 1;
    randu(noise, 0, 256);
    const Mat dark(noise.size(), CV_8U, Scalar(0));
    for (const Source source : {NOTHING, NEXT_FRAME, GYRO})
        for (const std::vector<Mat>& damaged : {std::vector<Mat>{dark}, {noise}, {dark, noise}})
        {
            if (!setting.reaches(int(damaged.size()) + 1))
                continue;
            std::vector<Mat> all = frames;
            all.insert(all.end(), damaged.begin(), damaged.end());
            const int last = int(all.size());
            all.push_back(street.frame(last));
            const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), source);
            AckermannMotion m;
            for (int i = 0; i <= last; i++)
                m = correctFrame(*corrector, all, i, source);
            SCOPED_TRACE(testing::Message()
                         << NAMES[source] << " " << damaged.size() << " from " << damaged[0].at<uchar>(0));
            EXPECT_TRUE(corrector->isTracked());
            expectTruth(setting, setting.camera, street.truth(setting, last), m, source);
        }
}

// Where frames are missing, one whose points aren't found again is expected to be of the same drive.
TEST_P(SequenceModes, motion_after_a_gap)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), NOTHING);
    for (int i = 0; i < FRAMES; i++)
        correctFrame(*corrector, frames, i, NOTHING);
    const int later = FRAMES + 8;
    Mat other, corrected;
    flip(street.frame(later), other, 0); // with nothing of the images before
    corrector->setTimestamp(later * INTERVAL);
    const AckermannMotion m = corrector->correct(other, corrected);
    EXPECT_FALSE(corrector->isTracked());
    ASSERT_EQ(MOTION_OK, m.status);
    const Simulator exact = Simulator::fromMotion(setting.camera, street.truth(setting, later));
    const double left = exact.meanDisplacement(Simulator::fromMotion(setting.camera, m));
    RecordProperty("left", format("%.2f of %.2f, expected %.2f", left, exact.meanDisplacement(), m.expectedResidual));
    EXPECT_LT(left, 2 * m.expectedResidual);
    EXPECT_GT(m.probabilityWorse, 0);
    EXPECT_LT(m.probabilityWorse, 0.5); // else it isn't corrected
    if (setting.yawChange == 0)
    {
        EXPECT_LT(left, 0.6 * exact.meanDisplacement());
    }
}

// What isn't there any more leaves nothing.
TEST_P(SequenceModes, state_of_sources)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const Twin same = Twin();
    const Ptr<RollingShutterCorrector> plain = createCorrector(setting, same, NOTHING),
                                       withGyro = createCorrector(setting, same, GYRO);
    for (int i = 0; i < FRAMES; i++)
    {
        if (i + 1 == FRAMES)
            withGyro->clearGyro();
        const AckermannMotion expected = correctFrame(*plain, frames, i, NOTHING),
                              motion = correctFrame(*withGyro, frames, i, NOTHING);
        if (i + 1 == FRAMES)
            expectSame(expected, motion);
    }
    // In the dark it goes on, but nobody knows how it shakes.
    Mat corrected;
    plain->setTimestamp(FRAMES * INTERVAL);
    const AckermannMotion dark = plain->correct(Mat(setting.camera.imageSize, CV_8U, Scalar(0)), corrected);
    ASSERT_EQ(MOTION_OK, dark.status);
    EXPECT_EQ(0, dark.pitchRate);
    EXPECT_EQ(0, dark.rollRate);
    EXPECT_TRUE(dark.rotationCurve.empty());
    if (setting.yawChange == 0)
    {
        EXPECT_NEAR(street.truth(setting, FRAMES).alpha, dark.alpha, 0.2 * std::abs(dark.alpha));
    }
}

// Neither what is seen nor what is found depends on since when something is given: its error may be that of all frames.
TEST_P(SequenceModes, seen_beside_what_is_given)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const Ptr<RollingShutterCorrector> always = createCorrector(setting, Twin(), GIVEN),
                                       atLast = createCorrector(setting, Twin(), NOTHING),
                                       never = createCorrector(setting, Twin(), NOTHING);
    for (int i = 0; i < FRAMES; i++)
    {
        if (i + 1 == FRAMES)
            atLast->setPrior(always->getPrior());
        const AckermannMotion a = correctFrame(*always, frames, i, GIVEN), b = correctFrame(*atLast, frames, i, GIVEN),
                              alone = correctFrame(*never, frames, i, NOTHING);
        if (i + 1 < FRAMES)
            continue;
        // Of the instant, as that of the motion is.
        const double sigma = std::sqrt(alone.metricCovariance(setting.camera)(0, 0));
        RecordProperty("ratio", format("%.3f", b.seenYawRateSigma / sigma));
        EXPECT_GT(b.seenYawRateSigma, 0.9 * sigma);
        EXPECT_GT(b.seenSpeedSigma, 0);
        expectSame(b, a);
    }
}

// An image that comes again, as converters of frame rates repeat them, isn't one of a car that stands.
TEST_P(SequenceModes, same_image_again)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    for (const int source : {int(NOTHING), int(GIVEN), int(NEXT_FRAME)})
    {
        std::vector<Mat> repeated = frames;
        const int at = FRAMES / 2;
        repeated.insert(repeated.begin() + at, repeated[at]);
        const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), source);
        AckermannMotion before;
        for (int i = 0; i <= FRAMES; i++)
        {
            SCOPED_TRACE(testing::Message() << NAMES[source] << " " << i);
            const AckermannMotion m = correctFrame(*corrector, repeated, i, source);
            if (i == at + 1)
                expectSame(before, m);
            double speed;
            if (i > 1 && setting.yawChange == 0)
            {
                ASSERT_EQ(MOTION_OK, m.status);
                EXPECT_FALSE(m.contradictsPrior);
                EXPECT_TRUE(!m.speed(setting.camera, speed) ||
                            std::abs(speed - setting.metric.speed) < 3 * m.speedSigma)
                    << speed << " " << m.speedSigma;
            }
            before = m;
        }
    }
}

// Nor does an encoder leave it as it was, once or twice. A car that is given to stand does.
TEST_P(SequenceModes, nearly_same_image_again)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const int at = FRAMES / 2;
    std::vector<Mat> copies;
    for (int i = 0; i < 2; i++)
    {
        Mat noise(frames[0].size(), CV_8S);
        RNG(5 + i).fill(noise, RNG::NORMAL, 0, 0.6);
        copies.push_back(frames[at - 1].clone());
        cv::add(copies[i], noise, copies[i], noArray(), CV_8U);
    }
    for (int count = 1; count <= 2; count++)
    {
        std::vector<Mat> repeated = frames;
        repeated.insert(repeated.begin() + at, copies.begin(), copies.begin() + count);
        const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), NOTHING),
                                           undisturbed = createCorrector(setting, Twin(), NOTHING);
        AckermannMotion expected;
        for (int i = 0; i < int(repeated.size()); i++)
        {
            SCOPED_TRACE(testing::Message() << count << " " << i);
            const AckermannMotion m = correctFrame(*corrector, repeated, i, NOTHING);
            const bool isCopy = i >= at && i < at + count;
            if (!isCopy)
                expected = correctFrame(*undisturbed, frames, i < at ? i : i - count, NOTHING);
            ASSERT_EQ(expected.status, m.status);
            EXPECT_NEAR(expected.alpha, m.alpha, 2 * std::sqrt(m.covariance(0, 0)) + 1e-12);
            EXPECT_TRUE(!isCopy || count > 1 || expected.covariance == m.covariance);
            double speed;
            EXPECT_TRUE(setting.yawChange != 0 || !m.speed(setting.camera, speed) ||
                        std::abs(speed - setting.metric.speed) < 3 * m.speedSigma)
                << speed << " " << m.speedSigma;
            EXPECT_FALSE(isCopy && corrector->isTracked());
        }
    }
    const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), NOTHING);
    for (int i = 0; i < at; i++)
        correctFrame(*corrector, frames, i, NOTHING);
    MotionPrior rest;
    rest.speedSigma = 0.1;
    corrector->setPrior(rest);
    Mat corrected;
    corrector->setTimestamp(at * INTERVAL);
    EXPECT_NE(MOTION_OK, corrector->correct(copies[0], corrected).status);
}

// Nor does it stop at once if that is the next image, or start again at once if it is that image.
TEST_P(SequenceModes, nearly_same_image_next)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const int at = FRAMES / 2;
    std::vector<Mat> repeated = frames;
    Mat noise(frames[0].size(), CV_8S);
    RNG(5).fill(noise, RNG::NORMAL, 0, 0.6);
    cv::add(frames[at - 1], noise, repeated[at], noArray(), CV_8U);
    const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), NEXT_FRAME),
                                       undisturbed = createCorrector(setting, Twin(), NEXT_FRAME);
    for (int i = 0; i < FRAMES; i++)
    {
        SCOPED_TRACE(i);
        const AckermannMotion m = correctFrame(*corrector, repeated, i, NEXT_FRAME),
                              expected = correctFrame(*undisturbed, frames, i, NEXT_FRAME);
        ASSERT_EQ(expected.status, m.status);
        EXPECT_NEAR(expected.alpha, m.alpha, 3 * std::sqrt(m.covariance(0, 0)) + 1e-12);
        EXPECT_FALSE(i == at && corrector->isTracked());
    }
}

// Nor does a car stand of which each image comes twice.
TEST_P(SequenceModes, each_image_twice)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    for (const int source : {int(NOTHING), int(NEXT_FRAME)})
    {
        std::vector<Mat> twice;
        for (const Mat& frame : frames)
            twice.insert(twice.end(), 2, frame);
        const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), source);
        AckermannMotion before;
        for (int i = 0; i < 2 * FRAMES; i++)
        {
            SCOPED_TRACE(testing::Message() << NAMES[source] << " " << i);
            const AckermannMotion m = correctFrame(*corrector, twice, i, source);
            // The first copy is of a car that stands, for all that is known: half a picture of bonnet is as well, then.
            if (i == 2 && m.status != MOTION_OK)
                break;
            if (i > 2)
            {
                EXPECT_EQ(MOTION_OK, m.status);
            }
            if (i > 2 && i % 2 == 1)
                expectSame(before, m);
            before = m;
        }
    }
}

// Images that a converter of frame rates repeats, bit by bit or nearly, from the first one on: the motion between the
// others is that of their own times.
TEST_P(SequenceModes, frame_rates_that_were_multiplied)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const bool isHalfBonnet = MODES[GetParam()].name == std::string("bonnet");
    for (const int times : {2, 3, 6})
        for (const double noise : {0., 0.6})
            for (const bool hasNext : {false, true})
            {
                std::vector<Mat> shown;
                RNG rng(5);
                for (const Mat& frame : frames)
                    for (int k = 0; k < times; k++)
                    {
                        Mat coded(frame.size(), CV_8S);
                        rng.fill(coded, RNG::NORMAL, 0, k > 0 ? noise : 0);
                        shown.push_back(frame.clone());
                        cv::add(frame, coded, shown.back(), noArray(), CV_8U);
                    }
                const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), NOTHING),
                                                   original = createCorrector(setting, Twin(), NOTHING);
                AckermannMotion expected;
                for (int i = 0; i < int(shown.size()); i++)
                {
                    SCOPED_TRACE(testing::Message() << times << " " << noise << " " << hasNext << " " << i);
                    Mat corrected;
                    corrector->setTimestamp(i * INTERVAL / times);
                    if (hasNext && i + 1 < int(shown.size()))
                        corrector->setNextFrame(shown[i + 1], (i + 1) * INTERVAL / times);
                    const AckermannMotion m = corrector->correct(shown[i], corrected);
                    if (i % times == 0)
                        expected = correctFrame(*original, frames, i / times, NOTHING);
                    if (i < times)
                    {
                        // The same image tells nothing; nearly the same is of a car that stands, for all that is known.
                        if (noise == 0)
                        {
                            EXPECT_EQ(expected.status, m.status);
                            EXPECT_EQ(expected.alpha, m.alpha);
                            EXPECT_EQ(expected.expectedResidual, m.expectedResidual);
                        }
                        continue;
                    }
                    if (i == times && m.status != MOTION_OK && isHalfBonnet)
                        break; // it stands as well
                    ASSERT_EQ(MOTION_OK, m.status);
                    EXPECT_NEAR(expected.alpha, m.alpha, 3 * std::sqrt(m.covariance(0, 0)));
                    double speed;
                    EXPECT_TRUE(setting.yawChange != 0 || !m.speed(setting.camera, speed) ||
                                std::abs(speed - setting.metric.speed) < 3 * m.speedSigma)
                        << speed << " " << m.speedSigma;
                }
            }
}

// Points show the mean of an interval: an exact rate of the instant doesn't contradict it.
TEST(RSAckermann_SequenceModes, exact_yaw_rates_of_a_car_that_weaves)
{
    Setting setting = settingOf({"weaves", [](Setting& s) { s.yawChange = -1.5; }});
    const StreetImages street(setting);
    for (const bool isGiven : {false, true})
    {
        const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), NOTHING);
        for (int i = 0; i < FRAMES; i++)
        {
            MotionPrior prior;
            prior.yawRate = setting.metric.yawRate + setting.yawChange * i * INTERVAL;
            prior.yawRateSigma = isGiven ? 0.3 * CV_PI / 180 : 0;
            corrector->setPrior(prior);
            Mat corrected;
            const AckermannMotion m = corrector->correct(street.frame(i), corrected);
            double found;
            if (i == 0 || !m.yawRate(setting.camera, found))
                continue;
            EXPECT_FALSE(m.contradictsPrior) << i;
            EXPECT_NEAR(prior.yawRate, found, 3 * std::sqrt(m.metricCovariance(setting.camera)(0, 0))) << isGiven << i;
        }
    }
}

// A longer lens sees less of a turn.
TEST_P(SequenceModes, uncertain_focal_length)
{
    if (GetParam() > 2)
        return; // one is as good as another
    SCOPED_TRACE(MODES[GetParam()].name);
    Setting uncertain = setting;
    const double relative = 0.1;
    uncertain.camera.focalSigma = relative * setting.camera.cameraMatrix(0, 0);
    const Ptr<RollingShutterCorrector> exact = createCorrector(setting, Twin(), NOTHING),
                                       other = createCorrector(uncertain, Twin(), NOTHING);
    for (int i = 0; i < FRAMES; i++)
    {
        AckermannMotion a = correctFrame(*exact, frames, i, NOTHING), b = correctFrame(*other, frames, i, NOTHING);
        if (i == 0)
            continue;
        EXPECT_EQ(a.alpha, b.alpha);
        EXPECT_NEAR(std::pow(relative * a.alpha, 2), b.covariance(0, 0) - a.covariance(0, 0),
                    1e-6 * b.covariance(0, 0));
    }
}

// Lines that are read more slowly than is given are displaced by as much more, by the same motion per second.
TEST_P(SequenceModes, uncertain_line_delay)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const double relative = 0.1;
    Setting known = setting, uncertain = setting;
    for (Setting* s : {&known, &uncertain})
        s->camera.lineDelay *= 1 + relative;
    uncertain.camera.lineDelaySigma = relative * uncertain.camera.lineDelay;
    const Ptr<RollingShutterCorrector> one = createCorrector(known, Twin(), NOTHING),
                                       other = createCorrector(uncertain, Twin(), NOTHING);
    AckermannMotion a, b;
    for (int i = 0; i < FRAMES; i++)
    {
        a = correctFrame(*one, frames, i, NOTHING);
        b = correctFrame(*other, frames, i, NOTHING);
    }
    EXPECT_EQ(a.alpha, b.alpha);
    EXPECT_EQ(a.expectedRaw, b.expectedRaw);
    EXPECT_NEAR(std::hypot(a.expectedResidual, relative * a.expectedRaw), b.expectedResidual, 1e-9);
    const Simulator exact = Simulator::fromMotion(setting.camera, street.truth(setting, FRAMES - 1));
    EXPECT_LT(exact.meanDisplacement(Simulator::fromMotion(uncertain.camera, b)), 2 * b.expectedResidual);
}

// Another street before, of which nothing is told, is forgotten.
TEST_P(SequenceModes, another_street_before)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const Twin same = Twin();
    Setting elsewhere = setting;
    elsewhere.metric.yawRate *= -0.5;
    elsewhere.metric.speed *= 0.7;
    std::swap(elsewhere.metric.leftDistance, elsewhere.metric.rightDistance);
    const StreetImages before(elsewhere);
    std::vector<Mat> others;
    for (int i = 0; i < FRAMES; i++)
        others.push_back(before.frame(i + 50));
    for (const int source : {NOTHING, NEXT_FRAME, GIVEN})
    {
        SCOPED_TRACE(NAMES[source]);
        const Ptr<RollingShutterCorrector> used = createCorrector(setting, same, source),
                                           unused = createCorrector(setting, same, source);
        Mat corrected;
        for (int i = 0; i < FRAMES; i++)
        {
            used->setTimestamp((i - FRAMES) * INTERVAL);
            used->correct(others[i], corrected);
        }
        for (int i = 0; i < FRAMES; i++)
        {
            const AckermannMotion expected = correctFrame(*unused, frames, i, source),
                                  motion = correctFrame(*used, frames, i, source);
            EXPECT_EQ(expected.status, motion.status) << i;
            // The camera is the same: what the other street shows of it is kept.
            const double sigma = std::sqrt(expected.covariance(0, 0));
            EXPECT_NEAR(expected.alpha, motion.alpha, sigma) << i;
            EXPECT_NEAR(sigma, std::sqrt(motion.covariance(0, 0)), 0.5 * sigma) << i;
            EXPECT_NEAR(expected.seenSpeed, motion.seenSpeed, expected.seenSpeedSigma + 1e-9) << i;
        }
    }
}

// In the dark the motion is expected for a second, and its turns are those of a gyro if there is one. A clock that is
// set back begins another sequence.
TEST_P(SequenceModes, dark_and_again)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const Mat dark(setting.camera.imageSize, CV_8U, Scalar(0));
    const double unit = setting.camera.secondsPerUnitTime();
    for (const int source : {NOTHING, GYRO})
    {
        const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), source);
        std::vector<AckermannMotion> first;
        for (int i = 0; i < FRAMES; i++)
            first.push_back(correctFrame(*corrector, frames, i, source));
        Mat corrected;
        for (const double after : {0.4, 0.9, 1.1, 1.9})
        {
            SCOPED_TRACE(testing::Message() << NAMES[source] << " " << after);
            const double seconds = (FRAMES - 1) * INTERVAL + after;
            corrector->setTimestamp(seconds);
            const AckermannMotion m = corrector->correct(dark, corrected);
            EXPECT_EQ(after < 1 ? MOTION_OK : MOTION_TOO_FEW_SEGMENTS, m.status);
            EXPECT_EQ(after < 1, m.wallOffset != 0 || m.wallSlope != 0); // of what was seen before
            if (source != GYRO || seconds > GYRO_END)
                continue;
            const Vec3d rate = setting.shakingAt(seconds) * unit;
            EXPECT_NEAR((setting.metric.yawRate + setting.yawChange * seconds) * unit / 2, m.alpha, 0.02 * unit / 2);
            EXPECT_NEAR(rate[0], m.rollRate, std::max(0.01 * unit, std::min(2 * m.rollRateSigma, 0.02 * unit)));
            EXPECT_NEAR(rate[1], m.pitchRate, 0.01 * unit);
        }
        for (int i = 0; i < FRAMES; i++)
            expectSame(first[i], correctFrame(*corrector, frames, i, source));
    }
}

// How far the scene seems to move, and how well that is known, doesn't depend on its scale.
TEST_P(SequenceModes, displacement_without_a_scale)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const Ptr<RollingShutterCorrector> plain = createCorrector(setting, Twin(), NOTHING),
                                       scaled = createCorrector(setting, Twin(), NOTHING);
    MotionPrior prior;
    prior.speed = setting.metric.speed;
    prior.speedSigma = 0.01;
    scaled->setPrior(prior);
    for (int i = 0; i < FRAMES; i++)
    {
        const AckermannMotion a = correctFrame(*plain, frames, i, NOTHING),
                              b = correctFrame(*scaled, frames, i, NOTHING);
        if (i < 2)
            continue;
        EXPECT_NEAR(a.expectedRaw, b.expectedRaw, 0.05 * a.expectedRaw);
        EXPECT_NEAR(a.expectedResidual, b.expectedResidual, 0.3 * a.expectedResidual);
    }
}

// A depth up to scale and shift changes the motion of its frame, unless a gyro knows that, and no other one. One that
// isn't that of the frame changes nothing.
TEST_P(SequenceModes, relative_depth)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const int deep = FRAMES - 2;
    const Mat1f own = 7 * street.inverseDepth(deep) - 2;
    const DepthMap depth(own, DEPTH_RAW, 1, DEPTH_RELATIVE), upsideDown(-own, DEPTH_RAW, 1, DEPTH_RELATIVE);
    for (int source = 0; source < SOURCES; source++)
    {
        if (setting.yawChange != 0 && source != GYRO)
            continue; // others see a mean
        const Ptr<RollingShutterCorrector> with = createCorrector(setting, Twin(), source),
                                           wrong = createCorrector(setting, Twin(), source),
                                           without = createCorrector(setting, Twin(), source);
        for (int i = 0; i < FRAMES; i++)
        {
            SCOPED_TRACE(testing::Message() << NAMES[source] << " " << i);
            const AckermannMotion expected = correctFrame(*without, frames, i, source),
                                  m = correctFrame(*with, frames, i, source, Twin(), i == deep ? depth : DepthMap()),
                                  refused = correctFrame(*wrong, frames, i, source, Twin(),
                                                         i == deep ? upsideDown : DepthMap());
            EXPECT_EQ(i == deep, with->isDepthUsed());
            EXPECT_FALSE(wrong->isDepthUsed());
            EXPECT_EQ(expected.alpha, refused.alpha);
            EXPECT_EQ(expected.expectedResidual, refused.expectedResidual);
            const bool isChanged = i == deep && source != GYRO;
            EXPECT_EQ(isChanged, expected.alpha != m.alpha);
            EXPECT_EQ(isChanged, expected.covariance != m.covariance);
            EXPECT_EQ(i == deep, expected.expectedResidual != m.expectedResidual);
            if (i != deep)
                continue;
            expectTruth(setting, setting.camera, street.truth(setting, i), m, source);
            EXPECT_LT(m.expectedResidual, m.expectedRaw);
            EXPECT_NEAR(expected.expectedRaw, m.expectedRaw, 0.1 * expected.expectedRaw);
            const double way = std::abs(setting.metric.speed) * setting.camera.secondsPerUnitTime();
            EXPECT_NEAR(way / 7, with->getUsedDepth().scale, 0.05 * way / 7);
            EXPECT_NEAR(way * 2 / 7, with->getUsedDepth().shift, 0.05 * way * 2 / 7);
        }
    }
}

// One in metres is used if it is that of the points: of others the points tell the factor or the mirror image, unless
// the factor may be its scale's.
TEST_P(SequenceModes, metric_depth)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const int deep = FRAMES - 2;
    const Mat1f own = 1 / street.inverseDepth(deep);
    Mat mirrored;
    flip(own, mirrored, 1);
    for (int source = 0; source < SOURCES; source++)
    {
        if (setting.yawChange != 0 && source != GYRO)
            continue; // others see a mean
        const struct
        {
            Mat values;
            double factor, scaleSigma;
            bool isUsed;
        } depths[] = {{own, 1, 0, true},
                      {1.02 * own, 1.02, 0, true},
                      {1.5 * own, 1.5, 0, false},
                      {own / 1.5, 1 / 1.5, 0, false},
                      {own / 1.2, 1 / 1.2, 0.2, true},
                      {mirrored, 1, 0.1, false}};
        for (const auto& given : depths)
        {
            const Ptr<RollingShutterCorrector> with = createCorrector(setting, Twin(), source),
                                               without = createCorrector(setting, Twin(), source);
            for (int i = 0; i < FRAMES; i++)
            {
                SCOPED_TRACE(testing::Message() << NAMES[source] << " " << i << " " << &given - depths);
                DepthMap depth(i == deep ? given.values : Mat());
                depth.scaleSigma = given.scaleSigma;
                const AckermannMotion expected = correctFrame(*without, frames, i, source),
                                      m = correctFrame(*with, frames, i, source, Twin(), depth);
                const bool isUsed = i == deep && given.isUsed;
                EXPECT_EQ(isUsed, with->isDepthUsed());
                EXPECT_EQ(isUsed, expected.expectedResidual != m.expectedResidual);
                if (!isUsed)
                    continue;
                expectTruth(setting, setting.camera, street.truth(setting, i), m, source);
                EXPECT_LT(m.expectedResidual, m.expectedRaw);
                double speed;
                m.speed(setting.camera, speed);
                EXPECT_NEAR(speed / setting.metric.speed, with->getUsedDepth().scale * given.factor, 0.02);
            }
        }
    }
}

// For a second what the frames let expect is better than a single image, which then goes by their yaw rate.
TEST_P(SequenceModes, single_image_within)
{
    if (setting.yawChange != 0)
        return; // what is seen is a mean
    SCOPED_TRACE(MODES[GetParam()].name);
    const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), NOTHING);
    for (int i = 0; i < FRAMES; i++)
        correctFrame(*corrector, frames, i, NOTHING);
    const Mat dark(setting.camera.imageSize, CV_8U, Scalar(0));
    RNG rng(3);
    const AckermannMotion truth = street.truth(setting, FRAMES);
    const Mat segments =
        simulation::randomSegments(Simulator::fromMotion(setting.camera, truth), simulation::SegmentOptions(), rng)
            .ends;
    Mat corrected;
    const auto correct = [&](double seconds, const Mat& lines) {
        corrector->setTimestamp((FRAMES - 1) * INTERVAL + seconds);
        return corrector->correctWithSegments(dark, lines, corrected);
    };
    const AckermannMotion soon = correct(0.6, segments), seen = correct(1.1, segments);
    ASSERT_EQ(MOTION_OK, soon.status);
    EXPECT_EQ(0, soon.inliers);
    ASSERT_EQ(MOTION_OK, seen.status);
    EXPECT_GT(seen.inliers, 0);
    Mat labels;
    const AckermannMotion alone =
        AckermannEstimator::create(setting.camera, setting.params.estimator)->estimate(segments, labels);
    EXPECT_NE(alone.alpha, seen.alpha);
    EXPECT_LT(std::abs(seen.alpha - truth.alpha),
              std::max(3 * std::sqrt(seen.covariance(0, 0)), std::abs(alone.alpha - truth.alpha)));
}

// The frames go on without given values that they contradict, in the dark as well.
TEST_P(SequenceModes, given_values_that_nothing_fits)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const MetricMotion& metric = setting.metric;
    std::vector<Mat> images = frames;
    images.push_back(Mat(setting.camera.imageSize, CV_8U, Scalar(0)));
    for (const bool isYawGiven : {false, true})
    {
        const Ptr<RollingShutterCorrector> plain = createCorrector(setting, Twin(), NOTHING),
                                           misled = createCorrector(setting, Twin(), NOTHING);
        MotionPrior prior;
        prior.speed = (isYawGiven ? 8 : -3) * metric.speed;
        prior.speedSigma = 0.01;
        prior.yawRate = 2;
        prior.yawRateSigma = isYawGiven ? 0.001 : 0;
        for (int i = 0; i <= FRAMES; i++)
        {
            SCOPED_TRACE(testing::Message() << isYawGiven << " " << i);
            if (i > 1)
                misled->setPrior(prior);
            const AckermannMotion expected = correctFrame(*plain, images, i, NOTHING),
                                  m = correctFrame(*misled, images, i, NOTHING);
            EXPECT_EQ(i > 1, m.contradictsPrior);
            EXPECT_EQ(expected.status, m.status);
            EXPECT_NEAR(expected.alpha, m.alpha, 0.01 * std::abs(expected.alpha));
            EXPECT_NEAR(expected.roadSlope, m.roadSlope, 0.01 * std::abs(expected.roadSlope));
            EXPECT_NEAR(expected.wallOffset, m.wallOffset, 0.01 * std::abs(expected.roadSlope));
            EXPECT_NEAR(expected.wallDistance, m.wallDistance, 0.02 * expected.wallDistance);
        }
    }
}

// A given value that the frames contradict takes none with it that they confirm.
TEST_P(SequenceModes, one_given_value_is_wrong)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const double unit = setting.camera.secondsPerUnitTime();
    for (const bool isYawRate : {false, true})
    {
        const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), NOTHING);
        MotionPrior prior;
        prior.speed = (isYawRate ? 1 : 3.6) * setting.metric.speed;
        prior.speedSigma = 0.1;
        prior.yawRate = setting.metric.yawRate + setting.yawChange * (FRAMES - 1) * INTERVAL + (isYawRate ? 1 : 0);
        prior.yawRateSigma = 0.002;
        AckermannMotion m;
        for (int i = 0; i < FRAMES; i++)
        {
            if (i == FRAMES - 1)
                corrector->setPrior(prior);
            m = correctFrame(*corrector, frames, i, NOTHING);
        }
        EXPECT_TRUE(m.contradictsPrior);
        double speed;
        EXPECT_TRUE(m.speed(setting.camera, speed));
        EXPECT_EQ(isYawRate ? SCALE_SPEED : SCALE_ROAD, m.scale);
        if (isYawRate)
            EXPECT_NEAR(prior.speed, speed, 0.2);
        else
            EXPECT_NEAR(prior.yawRate * unit / 2, m.alpha, 0.004 * unit / 2);
    }
}

// Without a gravity it is the gyro and what is given that know the yaw rate of a single image, each by its weight.
// A gyro is nothing that is given, which a single image could contradict.
TEST(RSAckermann_SequenceModes, nothing_is_seen_beside_a_gyro)
{
    for (const int source : {GYRO, GIVEN})
    {
        const Setting setting = settingOf({"alone", [](Setting& s) { s.params.sequence = false; }});
        const MetricMotion& m = setting.metric;
        const Simulator simulator =
            Simulator::fromMetric(setting.camera, m.yawRate, m.speed, m.leftDistance, m.rightDistance, m.wallDirection);
        RNG rng(12);
        const Mat segments = simulation::randomSegments(simulator, simulation::SegmentOptions(), rng).ends,
                  image(setting.camera.imageSize, CV_8U, Scalar(9));
        const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), source);
        corrector->setTimestamp(0.1);
        Mat corrected;
        const AckermannMotion motion = corrector->correctWithSegments(image, segments, corrected);
        ASSERT_EQ(MOTION_OK, motion.status);
        EXPECT_EQ(source == GIVEN, motion.seenYawRateSigma > 0);
        EXPECT_EQ(source == GIVEN, motion.seenYawRate != 0);
    }
}

// Of what is known of gravity; the first one changes nothing.
const std::function<void(RollingShutterCamera&, AckermannEstimator::Params&)> GRAVITY_CHANGES[] = {
    [](RollingShutterCamera&, AckermannEstimator::Params&) {},
    [](RollingShutterCamera& camera, AckermannEstimator::Params&) { camera.setRollPitch(0.002, 0.001); },
    [](RollingShutterCamera&, AckermannEstimator::Params& params) { params.gravitySigma *= 1.5; },
    [](RollingShutterCamera&, AckermannEstimator::Params& params) { params.vehiclePitchSigma *= 1.5; }};

// Whichever of what is known of gravity changes, roll and pitch begin anew; all else goes on.
TEST(RSAckermann_SequenceModes, gravity_that_changes)
{
    const Setting setting = settingOf({"shakes", [](Setting& s) { s.shaking = 0.004; }});
    const StreetImages street(setting);
    std::vector<Mat> frames;
    for (int i = 0; i < FRAMES; i++)
        frames.push_back(street.frame(i));
    AckermannMotion unchanged;
    for (int k = 0; k < 8; k++)
    {
        const bool isMisled = k / 4 == 1; // from now on; what is seen without given values goes on as well
        SCOPED_TRACE(testing::Message() << k % 4 << isMisled);
        const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), isMisled ? GIVEN : NOTHING);
        for (int i = 0; i < FRAMES; i++)
            correctFrame(*corrector, frames, i, NOTHING);
        RollingShutterCamera camera = setting.camera;
        RollingShutterCorrector::Params params = setting.params;
        GRAVITY_CHANGES[k % 4](camera, params.estimator);
        corrector->setCamera(camera);
        corrector->setParams(params);
        if (isMisled)
        {
            MotionPrior wrong = corrector->getPrior();
            wrong.yawRate = -2;
            corrector->setPrior(wrong);
        }
        // In the dark the state says what is expected.
        Mat corrected;
        corrector->setTimestamp(FRAMES * INTERVAL);
        const AckermannMotion dark = corrector->correct(Mat(camera.imageSize, CV_8U, Scalar(0)), corrected);
        ASSERT_EQ(MOTION_OK, dark.status);
        if (k % 4 == 0)
            unchanged = dark;
        EXPECT_EQ(isMisled, dark.contradictsPrior);
        EXPECT_EQ(k % 4 == 0, std::abs(dark.rollCorrection) > 1e-4);
        EXPECT_EQ(k % 4 == 0, std::abs(dark.pitchCorrection) > 1e-4);
        EXPECT_NEAR(unchanged.alpha, dark.alpha, 1e-9);
        EXPECT_NEAR(unchanged.roadSlope, dark.roadSlope, 1e-9);
    }
}

// The same image once more has the motion that it had, unless gravity isn't what it was.
TEST(RSAckermann_SequenceModes, same_image_with_another_gravity)
{
    const Setting setting = settingOf(MODES[0]);
    const StreetImages street(setting);
    std::vector<Mat> frames;
    for (int i = 0; i < FRAMES; i++)
        frames.push_back(street.frame(i));
    frames.push_back(frames.back());
    for (int k = 0; k < 4; k++)
    {
        const Ptr<RollingShutterCorrector> corrector = createCorrector(setting, Twin(), NOTHING);
        AckermannMotion last;
        for (int i = 0; i < FRAMES; i++)
            last = correctFrame(*corrector, frames, i, NOTHING);
        RollingShutterCamera camera = setting.camera;
        RollingShutterCorrector::Params params = setting.params;
        GRAVITY_CHANGES[k](camera, params.estimator);
        corrector->setCamera(camera);
        corrector->setParams(params);
        const AckermannMotion again = correctFrame(*corrector, frames, FRAMES, NOTHING);
        EXPECT_EQ(k == 0, last.rollCorrection == again.rollCorrection && last.pitchCorrection == again.pitchCorrection)
            << k << " " << last.rollCorrection << " " << again.rollCorrection;
    }
}

TEST(RSAckermann_SequenceModes, two_sources_of_a_yaw_rate)
{
    Setting s = settingOf(MODES[0]);
    s.params.sequence = false;
    s.params.estimator.gravitySigma = 0.1;
    RNG rng(3);
    const Mat segments = simulation::randomSegments(Simulator::fromMetric(s.camera, 0.3, 9, 4, 5, 0.08),
                                                    simulation::SegmentOptions(), rng)
                             .ends;
    double variance[4] = {0}, yawRate[4] = {0};
    for (int i = 1; i < 4; i++)
    {
        const bool hasGyro = (i & 1) != 0, isGiven = (i & 2) != 0;
        const Ptr<RollingShutterCorrector> corrector = createCorrector(s, Twin(), hasGyro ? GYRO : NOTHING);
        MotionPrior prior;
        prior.yawRate = 0.36; // that of the gyro is 0.3
        prior.yawRateSigma = isGiven ? 0.05 : 0;
        corrector->setPrior(prior);
        corrector->setTimestamp(0.1);
        Mat corrected;
        const AckermannMotion m =
            corrector->correctWithSegments(Mat(s.camera.imageSize, CV_8U, Scalar(0)), segments, corrected);
        ASSERT_EQ(MOTION_OK, m.status);
        variance[i] = m.metricCovariance(s.camera)(0, 0);
        m.yawRate(s.camera, yawRate[i]);
    }
    EXPECT_NEAR(1, (1 / variance[1] + 1 / variance[2]) * variance[3], 0.1);
    EXPECT_NEAR((yawRate[1] / variance[1] + yawRate[2] / variance[2]) * variance[3], yawRate[3], 0.01);
}

// A given speed gives the metres as far as it is known better than what the road and the camera's height show.
TEST_P(SequenceModes, metres_by_a_speed_of_some_sigma)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    Setting s = setting;
    s.params.estimator.scaleFromRoad = false;
    const double errors[] = {0, 0.25}, sigmas[] = {0.02, 0.5}; // over the speed
    for (int k = 0; k < 2; k++)
    {
        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(s.camera, s.params);
        MotionPrior prior;
        prior.speed = s.metric.speed * (1 + errors[k]);
        prior.speedSigma = std::abs(s.metric.speed) * sigmas[k];
        corrector->setPrior(prior);
        AckermannMotion m;
        for (int i = 0; i < FRAMES; i++)
            m = correctFrame(*corrector, frames, i, NOTHING);
        ASSERT_EQ(MOTION_OK, m.status);
        EXPECT_EQ(SCALE_SPEED, m.scale);
        double speed;
        ASSERT_TRUE(m.speed(s.camera, speed));
        const double sigma = std::sqrt(m.metricCovariance(s.camera)(1, 1));
        EXPECT_EQ(m.speedSigma, sigma);
        EXPECT_LT(sigma, 1.001 * prior.speedSigma);
        EXPECT_NEAR(s.metric.speed, speed, 3 * sigma);
        EXPECT_NEAR(s.metric.speed, speed, (k == 0 ? 0.04 : 0.15) * std::abs(s.metric.speed));
    }
}

INSTANTIATE_TEST_CASE_P(RSAckermann, SequenceModes, testing::Range(0, int(sizeof(MODES) / sizeof(*MODES))));

}} // namespace opencv_test::
