// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/factors/driving_prior.hpp"

// doc/theory.md, "Prior": its numbers.

namespace opencv_test { namespace {

typedef AckermannEstimator::Params Params;

const double PRIOR_WALL = 15, WALL_SIGMA = 0.9, PRIOR_SPEED = 12, SPEED_SIGMA = 0.8, CORRELATION = 0.6;

// Standard deviation of the logarithm of a speed over a wall's distance, whose logarithm has the given one.
double scaledSpeedSigma(double wallSigma)
{
    return std::sqrt(SPEED_SIGMA * SPEED_SIGMA + wallSigma * wallSigma - 2 * CORRELATION * SPEED_SIGMA * wallSigma);
}

// A speed and a wall's distance of the prior: drivers are slow where walls are near.
void drawSpeedAndWall(RNG& rng, double wallSigma, double& speed, double& wall)
{
    const double common = rng.gaussian(1), own = rng.gaussian(1);
    speed = PRIOR_SPEED * std::exp(SPEED_SIGMA * common);
    wall = PRIOR_WALL * std::exp(wallSigma * (CORRELATION * common + std::sqrt(1 - CORRELATION * CORRELATION) * own));
}

DrivingPrior makeDrive(const RollingShutterCamera& camera, const MotionPrior& prior = MotionPrior(),
                       const Params& params = Params())
{
    return DrivingPrior(prior, camera, params);
}

MotionPrior givenSpeed(double speed, double sigma)
{
    MotionPrior prior;
    prior.speed = speed;
    prior.speedSigma = sigma;
    return prior;
}

//! Where the density of a speed's logarithm is largest if it has been measured, and its curvature as a sigma.
Vec2d measuredLogarithm(double speed, double sigma)
{
    const Params params;
    Vec2d best(0, 0);
    double least = DBL_MAX;
    for (double x = -3; x < 5; x += 1e-5)
    {
        const double usual = (x - std::log(params.priorSpeed)) / params.priorSpeedLogSigma,
                     measured = (std::exp(x) - speed) / sigma, cost = usual * usual + measured * measured;
        if (cost < least)
            best[0] = x;
        least = std::min(cost, least);
    }
    best[1] = 1 / std::hypot(1 / params.priorSpeedLogSigma, std::exp(best[0]) / sigma);
    return best;
}

Model movingModel(double speed, double azimuth)
{
    Model m;
    m.direction = speed < 0 ? -1 : 1;
    m[P_ALPHA] = 0.004;
    m[P_B] = speed * std::cos(azimuth);
    m[P_D] = speed * std::sin(azimuth);
    m[P_LAMBDA] = 0.7;
    m[P_STREET] = 0.05;
    return m;
}

TEST(RSAckermann_DrivingPrior, density_of_the_yaw_rate)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const DrivingPrior drive = makeDrive(camera);
    const double scale = drive.alphaScale(), step = 0.01 * scale;
    EXPECT_NEAR(5 * degree * camera.secondsPerUnitTime() / 2, scale, 1e-12);
    double sum = 0, within = 0;
    for (int i = -400000; i <= 400000; i++)
    {
        const double p = step * std::exp(drive.logYawDensity(i * step));
        sum += p;
        within += std::abs(i) <= 100 ? p : 0;
    }
    EXPECT_NEAR(1, sum, 1e-3);
    EXPECT_NEAR(0.5774, within, 5e-3); // 1 / sqrt 3: Student's t with two degrees of freedom up to its scale

    Params params;
    params.priorYawRate = 0.3;
    EXPECT_NEAR(0.3 * camera.secondsPerUnitTime() / 2, makeDrive(camera, MotionPrior(), params).alphaScale(), 1e-12);

    MotionPrior gyro;
    gyro.yawRate = 0.2;
    gyro.yawRateSigma = 0.01;
    const DrivingPrior given = makeDrive(camera, gyro);
    EXPECT_TRUE(given.yawRateIsGiven());
    EXPECT_NEAR(0.2 * camera.secondsPerUnitTime() / 2, given.given().alpha, 1e-12);
    const auto together = [](double a, double b) { return a * b / std::hypot(a, b); };
    EXPECT_NEAR(together(0.01 * camera.secondsPerUnitTime() / 2, scale), given.alphaScale(), 1e-12);
    EXPECT_NEAR(given.given().alpha, given.expectedAlpha(), 0.02 * given.given().alpha);
    RollingShutterCamera uncertain = camera;
    uncertain.lineDelaySigma = 0.1 * camera.lineDelay;
    EXPECT_NEAR(together(std::hypot(0.01, 0.1 * 0.2) * camera.secondsPerUnitTime() / 2, scale),
                makeDrive(uncertain, gyro).alphaScale(), 1e-12);
}

// A given yaw rate multiplies the usual density: an exact one replaces it, and a vague one leaves it as it is.
TEST(RSAckermann_DrivingPrior, density_of_a_given_yaw_rate)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const DrivingPrior usual = makeDrive(camera);
    const double unit = camera.secondsPerUnitTime() / 2;
    for (const double sigma : {1e-4, 0.01, 0.1, 1., 30.})
        for (const double rate : {0., -0.05, 0.4})
        {
            MotionPrior gyro;
            gyro.yawRate = rate;
            gyro.yawRateSigma = sigma;
            const DrivingPrior given = makeDrive(camera, gyro);
            const double step = 0.01 * given.alphaScale(), range = 300 * usual.alphaScale();
            double sum = 0;
            Jet r[DrivingPrior::MAX_YAW_RESIDUALS];
            const int steps = int(std::min(range / step, 100000.)), middle = int(rate * unit / step);
            for (int i = middle - steps; i <= middle + steps; i++)
            {
                given.evaluateYaw(i * step, false, r);
                sum += step * std::exp(given.logYawDensity(i * step) - r[0].value * r[0].value / 2);
            }
            EXPECT_NEAR(1, sum, 2e-3) << rate << " +- " << sigma;
            EXPECT_EQ(1, given.evaluateYaw((rate + sigma) * unit, false, r));
            EXPECT_NEAR(1, r[0].value, 1e-9);
            EXPECT_EQ(2, given.evaluateYaw((rate + sigma) * unit, true, r));
            if (sigma > 10)
            {
                EXPECT_NEAR(usual.logYawDensity(0), given.logYawDensity(0), 0.01);
                EXPECT_NEAR(usual.logRest(), given.logRest(), 1e-3);
                EXPECT_NEAR(0, given.expectedAlpha(), 1e-4 * unit);
            }
        }
}

// A line delay of the median leaves the expected speed as it is; its uncertainty adds.
TEST(RSAckermann_DrivingPrior, unknown_line_delay)
{
    RollingShutterCamera known = simulation::paperCamera(), unknown = known;
    unknown.lineDelay = 0;
    Params params;
    params.priorReadoutTime = known.lineDelay * known.imageSize.height;
    params.priorReadoutTimeLogSigma = 0.5;
    const DrivingPrior a = makeDrive(known, MotionPrior(), params), b = makeDrive(unknown, MotionPrior(), params);
    EXPECT_NEAR(a.expectedScaledSpeed(), b.expectedScaledSpeed(), 1e-12);
    EXPECT_NEAR(a.alphaScale() * std::exp(0.5 * 0.5), b.alphaScale(), 1e-12);
    double logG, sigma, widerSigma;
    a.anyRoad(logG, sigma);
    b.anyRoad(logG, widerSigma);
    EXPECT_NEAR(std::hypot(sigma, 0.5), widerSigma, 1e-12);
    params.priorReadoutTime *= 2;
    EXPECT_NEAR(2 * a.expectedScaledSpeed(), makeDrive(unknown, MotionPrior(), params).expectedScaledSpeed(), 1e-12);
}

TEST(RSAckermann_DrivingPrior, ratio_of_the_walls)
{
    Params params;
    params.priorWallRatioLogSigma = 0.3;
    const DrivingPrior usual = makeDrive(simulation::paperCamera()),
                       alike = makeDrive(simulation::paperCamera(), MotionPrior(), params);
    Model m = movingModel(usual.expectedScaledSpeed(), 0);
    m[P_LAMBDA] = 2;
    const MotionHypothesis two(MODEL_4LA, 2);
    const auto costOfRatio = [&](const DrivingPrior& prior) {
        Jet r[DrivingPrior::MAX_RESIDUALS];
        double cost = 0;
        for (int i = prior.evaluate(m, two, r) - 1; i >= 0; i--)
            cost += r[i].value * r[i].value;
        return cost;
    };
    const double square = std::log(2.) * std::log(2.);
    EXPECT_NEAR(square / 0.09 - square / 0.64, costOfRatio(alike) - costOfRatio(usual), 1e-9);
    EXPECT_NEAR(std::log(0.3 / 0.8), alike.logVolume(two) - usual.logVolume(two), 1e-12);
}

TEST(RSAckermann_DrivingPrior, residual_of_the_yaw_rate_is_its_density)
{
    const DrivingPrior drive = makeDrive(simulation::paperCamera());
    Model m;
    Jet r[DrivingPrior::MAX_RESIDUALS];
    for (int i = -20; i <= 20; i++)
    {
        m[P_ALPHA] = 0.3 * i * drive.alphaScale();
        // The other one is that of the street's direction
        ASSERT_EQ(2, drive.evaluate(m, MotionHypothesis(MODEL_1LA, 0), r));
        EXPECT_NEAR(drive.logYawDensity(0) - drive.logYawDensity(m[P_ALPHA]), 0.5 * r[0].value * r[0].value, 1e-9) << i;
    }
}

TEST(RSAckermann_DrivingPrior, derivatives)
{
    const DrivingPrior drives[] = {makeDrive(simulation::paperCamera()),
                                   makeDrive(simulation::paperCamera(), givenSpeed(15, 1))};
    const MotionHypothesis structures[] = {MotionHypothesis(MODEL_1LA, 0), MotionHypothesis(MODEL_3LA, 1),
                                           MotionHypothesis(MODEL_4LA, 1), MotionHypothesis(MODEL_4LA, 2)};
    for (int d = 0; d < 2; d++)
        for (int s = 0; s < 8; s++)
        {
            Model m = movingModel(0.03, 0.1);
            m[P_ALPHA] *= s < 4 ? 1 : -1; // to the right, or to the left
            Jet r[DrivingPrior::MAX_RESIDUALS], up[DrivingPrior::MAX_RESIDUALS], down[DrivingPrior::MAX_RESIDUALS];
            const int n = drives[d].evaluate(m, structures[s % 4], r);
            ASSERT_GT(n, 0);
            for (int p = 0; p < PARAMETERS; p++)
            {
                const double h = 1e-7;
                Model a = m, b = m;
                a.value[p] += h;
                b.value[p] -= h;
                drives[d].evaluate(a, structures[s % 4], up);
                drives[d].evaluate(b, structures[s % 4], down);
                for (int i = 0; i < n; i++)
                {
                    const double expected = (up[i].value - down[i].value) / (2 * h);
                    EXPECT_NEAR(expected, r[i].derivative[p], 1e-5 * (1 + std::abs(expected)))
                        << d << " " << s << " " << i << " " << p;
                }
            }
        }
}

TEST(RSAckermann_DrivingPrior, speed)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const double unit = camera.secondsPerUnitTime();
    EXPECT_NEAR(PRIOR_SPEED * unit / PRIOR_WALL, makeDrive(camera).expectedScaledSpeed(), 1e-12);
    EXPECT_EQ(0, makeDrive(camera).givenDirection());
    // A given speed is as probable backward as forward.
    const DrivingPrior back = makeDrive(camera, givenSpeed(-20, 0.5));
    EXPECT_NEAR(20 * unit / PRIOR_WALL, back.expectedScaledSpeed(), 1e-3 * 20 * unit / PRIOR_WALL);
    EXPECT_EQ(-1, back.givenDirection());
    Params params;
    params.wallDistance = 5;
    EXPECT_NEAR(PRIOR_SPEED * unit / 5, makeDrive(camera, MotionPrior(), params).expectedScaledSpeed(), 1e-12);

    // The expected speed costs nothing, another one its logarithm over the standard deviation of speed and wall.
    Jet r[DrivingPrior::MAX_RESIDUALS];
    const DrivingPrior drive = makeDrive(camera);
    ASSERT_EQ(4, drive.evaluate(movingModel(2 * drive.expectedScaledSpeed(), 0), MotionHypothesis(MODEL_4LA, 1), r));
    EXPECT_NEAR(std::log(2.) / scaledSpeedSigma(WALL_SIGMA), r[1].value, 1e-6);
    // The error of a given speed has nothing to do with walls. What it leaves open is as usual, near rest as well.
    for (const Vec2d& speed : {Vec2d(12, 6), Vec2d(12, 0.1), Vec2d(0, 0.5), Vec2d(40, 400)})
    {
        const DrivingPrior given = makeDrive(camera, givenSpeed(speed[0], speed[1]));
        const Vec2d logarithm = measuredLogarithm(speed[0], speed[1]);
        EXPECT_NEAR(std::exp(logarithm[0]) * unit / PRIOR_WALL, given.expectedScaledSpeed(), 1e-6) << speed;
        given.evaluate(movingModel(2 * given.expectedScaledSpeed(), 0), MotionHypothesis(MODEL_4LA, 1), r);
        EXPECT_NEAR(std::log(2.) / std::hypot(logarithm[1], WALL_SIGMA), r[1].value, 1e-4) << speed;
    }
    // With two walls the distance of both, in the mean of the logarithms, is what is expected.
    Model m = movingModel(drive.expectedScaledSpeed() * 4, 0);
    m[P_LAMBDA] = 1. / 16;
    ASSERT_EQ(5, drive.evaluate(m, MotionHypothesis(MODEL_4LA, 2), r));
    EXPECT_NEAR(0, r[1].value, 1e-6);
    // With a wall that is given its own is left.
    m = movingModel(13 * unit / 5, 0);
    ASSERT_EQ(3, makeDrive(camera, givenSpeed(15, 1), params).evaluate(m, MotionHypothesis(MODEL_4LA, 1), r));
    const Vec2d logarithm = measuredLogarithm(15, 1);
    EXPECT_NEAR((std::log(13.) - logarithm[0]) / std::hypot(logarithm[1], params.wallDistanceLogSigma), r[1].value,
                1e-3);
    params.wallDistanceLogSigma = 0;
    makeDrive(camera, givenSpeed(15, 1), params).evaluate(m, MotionHypothesis(MODEL_4LA, 1), r);
    EXPECT_NEAR((std::log(13.) - logarithm[0]) / logarithm[1], r[1].value, 1e-3);
}

// The mount's add to the vehicle's, about whose axes they are: the roll of a camera that looks aside is its pitch.
TEST(RSAckermann_DrivingPrior, tilts_of_vehicle_and_mount)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.rollSigma = 0.03;
    camera.pitchSigma = 0.12;
    Params params;
    params.gravitySigma = 0.04;
    params.vehiclePitchSigma = 0.05;
    EXPECT_NEAR(0.05, TiltSigmas(camera, params).roll, 1e-12);  // 3-4-5
    EXPECT_NEAR(0.13, TiltSigmas(camera, params).pitch, 1e-12); // 5-12-13
    camera.heading = CV_PI / 2;
    EXPECT_NEAR(std::hypot(0.04, 0.12), TiltSigmas(camera, params).roll, 1e-12);
    EXPECT_NEAR(std::hypot(0.05, 0.03), TiltSigmas(camera, params).pitch, 1e-12);
    params.gravitySigma = 0; // exact, whatever the mount
    EXPECT_EQ(EXACT_GRAVITY, TiltSigmas(camera, params).roll);
    EXPECT_EQ(EXACT_GRAVITY, TiltSigmas(camera, params).pitch);
}

TEST(RSAckermann_DrivingPrior, rest)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    EXPECT_NEAR(0, makeDrive(camera).logRest(), 1e-12);
    EXPECT_NEAR(std::log(0.15 / 0.85) - 0.5 * 3 * 3, makeDrive(camera, givenSpeed(6, 2)).logRest(), 1e-9);
    MotionPrior gyro;
    gyro.yawRateSigma = 1e-5;
    EXPECT_NEAR(std::log(0.15 / 0.85), makeDrive(camera, gyro).logRest(), 1e-6);
    gyro.yawRateSigma = 5 * degree; // half of it is known
    const double probability = 0.5 * std::sqrt(0.3);
    EXPECT_NEAR(std::log(probability / (1 - probability)), makeDrive(camera, gyro).logRest(), 1e-9);
}

// Mean and standard deviation of what the distributions give, forward, at rest or not.
TEST(RSAckermann_DrivingPrior, state_of_a_sequence)
{
    Params params;
    params.standingProbability = 0.3;
    SequenceVector mean, sigma;
    stationaryState(simulation::paperCamera(), params, mean, sigma);
    RNG rng(5);
    const int draws = 400000;
    double sum = 0, squares = 0;
    for (int i = 0; i < draws; i++)
    {
        double speed, wall;
        drawSpeedAndWall(rng, WALL_SIGMA, speed, wall);
        speed *= rng.uniform(0., 1.) < params.standingProbability ? 0 : 1;
        sum += speed;
        squares += speed * speed;
    }
    EXPECT_NEAR(sum / draws, mean[SEQUENCE_SPEED], 0.15);
    EXPECT_NEAR(std::sqrt(squares / draws - sum / draws * sum / draws), sigma[SEQUENCE_SPEED], 0.3);
}

// The largest standard deviations of logarithms that are accepted.
TEST(RSAckermann_DrivingPrior, state_if_nothing_is_known)
{
    Params params;
    params.priorSpeedLogSigma = params.priorWallDistanceLogSigma = params.priorHeightLogSigma = 10;
    params.priorWallRatioLogSigma = params.priorReadoutTimeLogSigma = params.wallDistanceLogSigma = 10;
    ASSERT_NO_THROW(params.check());
    SequenceVector mean, sigma;
    stationaryState(simulation::paperCamera(), params, mean, sigma);
    EXPECT_TRUE(checkRange(Mat(mean)) && checkRange(Mat(sigma))) << mean << sigma;
}

// Where the camera looks makes no difference to where the car and its street go.
TEST(RSAckermann_DrivingPrior, azimuths_are_counted_from_the_heading)
{
    const MotionHypothesis structures[] = {MotionHypothesis(MODEL_NONE, 0), MotionHypothesis(MODEL_1LA, 0),
                                           MotionHypothesis(MODEL_4LA, 1), MotionHypothesis(MODEL_4LA, 2)};
    RollingShutterCamera ahead = simulation::paperCamera();
    ahead.height = 1.3;
    SequenceVector meanAhead, sigmaAhead;
    stationaryState(ahead, Params(), meanAhead, sigmaAhead);
    for (const double heading : {-CV_PI / 2, -0.3, 1.4})
    {
        RollingShutterCamera aside = ahead;
        aside.heading = heading;
        for (const MotionHypothesis& structure : structures)
        {
            MotionPrior given = givenSpeed(15, 1);
            given.wallDirectionSigma = 0.2;
            Jet expected[DrivingPrior::MAX_RESIDUALS], r[DrivingPrior::MAX_RESIDUALS];
            const int n = makeDrive(ahead, given).evaluate(movingModel(0.03, 0.1), structure, expected);
            given.wallDirection = heading;
            Model turned = movingModel(0.03, 0.1 + heading);
            turned[P_STREET] += heading;
            ASSERT_EQ(n, makeDrive(aside, given).evaluate(turned, structure, r));
            for (int i = 0; i < n; i++)
                EXPECT_NEAR(expected[i].value, r[i].value, 1e-9) << heading << " " << structure.motion << " " << i;
        }
        SequenceVector mean, sigma;
        stationaryState(aside, Params(), mean, sigma);
        mean[SEQUENCE_DIRECTION] -= heading;
        EXPECT_LT(cv::norm(mean, meanAhead), 1e-9) << heading;
        EXPECT_EQ(sigmaAhead, sigma) << heading;
        // The mount's deviations are about the camera's axes, as those of the state are.
        aside.rollSigma = 0.3;
        stationaryState(aside, Params(), mean, sigma);
        EXPECT_NEAR(std::hypot(0.3, sigmaAhead[SEQUENCE_ROLL]), sigma[SEQUENCE_ROLL], 1e-12) << heading;
        EXPECT_EQ(sigmaAhead[SEQUENCE_PITCH], sigma[SEQUENCE_PITCH]) << heading;
    }
}

TEST(RSAckermann_DrivingPrior, volume)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const double street = std::log(0.4);
    EXPECT_NEAR(street, makeDrive(camera).logVolume(MotionHypothesis(MODEL_1LA, 0)), 1e-9);
    EXPECT_NEAR(street + std::log(scaledSpeedSigma(WALL_SIGMA)),
                makeDrive(camera).logVolume(MotionHypothesis(MODEL_4LA, 1)), 1e-9);
    EXPECT_NEAR(street + std::log(scaledSpeedSigma(WALL_SIGMA / std::sqrt(2.))) + std::log(0.8),
                makeDrive(camera).logVolume(MotionHypothesis(MODEL_4LA, 2)), 1e-9);
}

// Speeds and walls of the prior, of which only those count that a camera would see pass in this way.
TEST(RSAckermann_DrivingPrior, road_of_walls_that_pass)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const double unit = camera.secondsPerUnitTime(), width = 0.03;
    RNG rng(12);
    for (int walls = 1; walls <= 2; walls++)
        for (double B = 0.02; B < 0.2; B *= 2.5)
        {
            Model model = movingModel(B, 0);
            model[P_LAMBDA] = walls == 2 ? 0.4 : 0;
            double sum = 0, squares = 0;
            int count = 0;
            for (int i = 0; i < 2000000; i++)
            {
                // A right wall 2.5 times as far away: the mean of the logarithms varies less than that of a single
                // wall.
                double speed, wall;
                drawSpeedAndWall(rng, walls == 2 ? WALL_SIGMA / std::sqrt(2.) : WALL_SIGMA, speed, wall);
                wall *= walls == 2 ? std::sqrt(0.4) : 1;
                if (std::abs(std::log(speed * unit / wall / B)) > width)
                    continue;
                const double logG = std::log(speed * unit / camera.height);
                sum += logG;
                squares += logG * logG;
                count++;
            }
            ASSERT_GT(count, 1000);
            const double mean = sum / count, sigma = std::sqrt(squares / count - mean * mean),
                         error = 4 * sigma / std::sqrt(double(count));
            double G, variance;
            makeDrive(camera).road(model, RoadLimit(), G, variance);
            EXPECT_NEAR(mean, std::log(G), error);
            EXPECT_NEAR(sigma, std::sqrt(variance) / G, error);
            model[P_B] = -B;
            model.direction = 1;
            double other;
            makeDrive(camera).road(model, RoadLimit(), other, variance);
            EXPECT_EQ(G, other) << "a right wall";
        }
}

TEST(RSAckermann_DrivingPrior, road)
{
    RollingShutterCamera camera = simulation::paperCamera();
    const double unit = camera.secondsPerUnitTime(), height = camera.height;
    double G, variance;
    makeDrive(camera).road(Model(), RoadLimit(), G, variance);
    EXPECT_EQ(0, G);
    EXPECT_EQ(0, variance);
    // Speed and height are the road's slope; the walls add next to nothing.
    makeDrive(camera, givenSpeed(15, 0.5)).road(movingModel(0.05, 0.2), RoadLimit(), G, variance);
    EXPECT_NEAR(15 * unit / height, G, 0.1 * 0.5 * unit / height);
    EXPECT_NEAR(0.5 * unit / height, std::sqrt(variance), 0.01 * 0.5 * unit / height);
    // Of a motion the other way it says nothing.
    Model back = movingModel(-0.05, 0.2);
    makeDrive(camera, givenSpeed(0.5, 0.5)).road(back, RoadLimit(), G, variance);
    EXPECT_LT(G, 0);
    // At rest, too.
    makeDrive(camera, givenSpeed(0, 0.5)).road(movingModel(0.05, 0.2), RoadLimit(), G, variance);
    EXPECT_EQ(0, G);
    EXPECT_NEAR(0.5 * unit / height, std::sqrt(variance), 1e-12);
    // With a wall and the height what isn't known of the wall is left open, if anything is.
    Params params;
    params.wallDistance = 2.5;
    params.wallDistanceLogSigma = 0.1;
    makeDrive(camera, MotionPrior(), params).road(movingModel(0.05, 0.2), RoadLimit(), G, variance);
    const double speedSigma = params.priorSpeedLogSigma, wallSigma = params.wallDistanceLogSigma,
                 wallShare = std::pow(wallSigma / std::hypot(speedSigma, wallSigma), 2),
                 faster = 0.05 / (PRIOR_SPEED * unit / 2.5);
    EXPECT_NEAR(0.05 * 2.5 / height * std::pow(faster, -wallShare), G, 1e-12);
    EXPECT_NEAR(wallShare * speedSigma * speedSigma, variance / (G * G), 1e-12);
    params.wallDistanceLogSigma = 0;
    makeDrive(camera, MotionPrior(), params).road(movingModel(0.05, 0.2), RoadLimit(), G, variance);
    EXPECT_NEAR(0.05 * 2.5 / height, G, 1e-12);
    EXPECT_EQ(0, variance);
    params.roadRatio = 3;
    makeDrive(camera, MotionPrior(), params).road(movingModel(0.05, 0.2), RoadLimit(), G, variance);
    EXPECT_NEAR(0.05 * 3, G, 1e-12);
    EXPECT_EQ(0, variance);
    // A camera of unknown height is where cameras are; one that looks to the side may not see the road.
    camera.height = 0;
    double known;
    makeDrive(simulation::paperCamera()).road(movingModel(0.05, 0.2), RoadLimit(), known, variance);
    const double share = variance / (known * known);
    makeDrive(camera).road(movingModel(0.05, 0.2), RoadLimit(), G, variance);
    EXPECT_NEAR(known * height / 1.3, G, 1e-12);
    EXPECT_NEAR(share + 0.35 * 0.35, variance / (G * G), 1e-12);
    camera.heading = CV_PI / 2;
    makeDrive(camera).road(movingModel(0.05, 0.2), RoadLimit(), G, variance);
    EXPECT_EQ(0, G);
}

// Against drives at random, each as probable as the ends of segments are above its road.
TEST(RSAckermann_DrivingPrior, road_below_segments)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const double unit = camera.secondsPerUnitTime(), width = 0.03, B = 0.15, lambda = 0.4;
    Model model = movingModel(B, 0);
    model[P_LAMBDA] = lambda;
    double open, openVariance;
    makeDrive(camera).road(model, RoadLimit(), open, openVariance);
    // The first ratio and the number of ends on a wall: far away, nearer than expected, an outlier.
    const double factors[] = {6, 1, 1};
    const int counts[] = {20, 20, 1};
    for (int k = 0; k < 3; k++)
    {
        std::vector<std::pair<bool, double>> ends; // on which wall, ratio
        RoadLimit limit;
        for (int i = 0; i < counts[k]; i++)
        {
            const bool isRight = i % 3 == 2;
            const double ratio = factors[k] * open / B * (1 + 0.1 * i) / (isRight ? lambda : 1);
            ends.push_back(std::make_pair(isRight, ratio));
            limit.add(isRight, ratio, 0.7);
        }
        RNG rng(7);
        double sum = 0, squares = 0, total = 0, squareTotal = 0;
        for (int i = 0; i < 4000000; i++)
        {
            // A right wall 2.5 times as far away.
            double speed, left;
            drawSpeedAndWall(rng, WALL_SIGMA / std::sqrt(2.), speed, left);
            left *= std::sqrt(lambda);
            if (std::abs(std::log(speed * unit / left / B)) > width)
                continue;
            double probability = 1;
            for (const auto& end : ends)
            {
                const double wall = (end.first ? left / lambda : left) / camera.height,
                             z = std::log(end.second / wall) / 0.06;
                probability *= std::pow(0.1 + 0.9 * 0.5 * std::erfc(-z / std::sqrt(2.)), 0.7 / 5);
            }
            const double logG = std::log(speed * unit / camera.height);
            total += probability;
            squareTotal += probability * probability;
            sum += probability * logG;
            squares += probability * logG * logG;
        }
        const double mean = sum / total, sigma = std::sqrt(squares / total - mean * mean),
                     error = 4 * sigma * std::sqrt(squareTotal) / total;
        double G, variance;
        makeDrive(camera).road(model, limit, G, variance);
        EXPECT_NEAR(mean, std::log(G), error) << k;
        EXPECT_NEAR(sigma, std::sqrt(variance) / G, error) << k;
        EXPECT_LT(G, (k == 1 ? 0.8 : 1.001) * open) << k;
        EXPECT_GT(G, (k == 0 ? 0.98 : k == 2 ? 0.8 : 0) * open) << k;
        // What is given is not to be corrected by what is seen.
        Params params;
        params.roadRatio = 5;
        makeDrive(camera, MotionPrior(), params).road(model, limit, G, variance);
        EXPECT_NEAR(5 * B, G, 1e-12);
    }
    // Beyond all bounds it is finite.
    for (double ratio = 1e-300; ratio < 1e300; ratio *= 1e30)
    {
        RoadLimit limit;
        for (int i = 0; i < 5000; i++)
            limit.add(i % 2 > 0, ratio, 1);
        double G, variance;
        makeDrive(camera).road(model, limit, G, variance);
        EXPECT_GT(G, 0);
        EXPECT_LT(G, 1.001 * open);
        EXPECT_GE(variance, 0);
        EXPECT_LE(variance, 1.001 * openVariance);
    }
    RoadLimit none;
    none.add(false, 0, 1);
    none.add(true, std::numeric_limits<double>::infinity(), 1);
    none.add(true, std::numeric_limits<double>::quiet_NaN(), 1);
    EXPECT_TRUE(none.empty());
}

// One end more or less changes the road a little, wherever it is: no number of ends decides.
TEST(RSAckermann_DrivingPrior, road_below_one_segment_more)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    Model model = movingModel(0.15, 0);
    model[P_LAMBDA] = 0.4;
    double open, variance;
    makeDrive(camera).road(model, RoadLimit(), open, variance);
    RoadLimit limit;
    double last = open;
    for (int i = 0; i < 30; i++)
    {
        limit.add(false, 0.5 * open / 0.15, 1);
        double G;
        makeDrive(camera).road(model, limit, G, variance);
        EXPECT_LT(G, last) << i;
        EXPECT_GT(G, 0.85 * last) << i;
        last = G;
    }
    EXPECT_LT(last, 0.6 * open);
}

}} // namespace
