// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_TEST_RSACKERMANN_DRIVE_SIMULATOR_HPP
#define OPENCV_TEST_RSACKERMANN_DRIVE_SIMULATOR_HPP

#include "test_simulator.hpp"
#include <functional>

namespace opencv_test { namespace simulation {

//! A sum of oscillations with random phases.
class Oscillation
{
public:
    //! @param size standard deviation. @param shortest, longest period in seconds.
    Oscillation(double size, double shortest, double longest, RNG& rng)
    {
        for (int i = 0; i < COUNT; i++)
        {
            amplitude[i] = size * std::sqrt(2. / COUNT);
            // One of each part of the range of frequencies.
            frequency[i] = 2 * CV_PI * (1 / longest + (1 / shortest - 1 / longest) * (i + rng.uniform(0., 1.)) / COUNT);
            phase[i] = rng.uniform(0., 2 * CV_PI);
        }
    }

    double at(double seconds) const
    {
        double sum = 0;
        for (int i = 0; i < COUNT; i++)
            sum += amplitude[i] * std::sin(frequency[i] * seconds + phase[i]);
        return sum;
    }

private:
    enum { COUNT = 4 };
    double amplitude[COUNT], frequency[COUNT], phase[COUNT];
};

//! A normal random process of a given spectrum.
class RandomSway
{
public:
    //! @param size standard deviation. @param spectrum of frequencies in Hz, in any unit. @param highest frequency.
    template <class Spectrum>
    RandomSway(double size, double highest, const Spectrum& spectrum, RNG& rng)
    {
        double sum = 0;
        for (int i = 0; i < COUNT; i++)
        {
            const double hertz = highest * (i + rng.uniform(0., 1.)) / COUNT, power = spectrum(hertz);
            frequency[i] = 2 * CV_PI * hertz;
            amplitude[i] = std::sqrt(2 * power);
            phase[i] = rng.uniform(0., 2 * CV_PI);
            sum += power;
        }
        for (double& a : amplitude)
            a *= size / std::sqrt(sum);
    }

    double at(double seconds) const
    {
        double sum = 0;
        for (int i = 0; i < COUNT; i++)
            sum += amplitude[i] * std::sin(frequency[i] * seconds + phase[i]);
        return sum;
    }

private:
    enum { COUNT = 400 };
    double amplitude[COUNT], frequency[COUNT], phase[COUNT];
};

//! Of a time in seconds: how far the suspension tilts a car to one side.
typedef std::function<double(double)> Sway;

//! Slow oscillations.
inline Sway oscillating(double size, RNG& rng)
{
    const Oscillation oscillation(size, 0.8, 4, rng);
    return [oscillation](double seconds) { return oscillation.at(seconds); };
}

//! A body on springs that a rough road shakes, with the resonance and the damping of usual cars.
inline Sway onSprings(double size, RNG& rng)
{
    const double resonance = 1.4, damping = 0.25;
    const RandomSway random(
        size, 3 * resonance,
        [=](double hertz) {
            const double r = hertz / resonance;
            return 1 / (std::pow(1 - r * r, 2) + std::pow(2 * damping * r, 2));
        },
        rng);
    return [random](double seconds) { return random.at(seconds); };
}

//! A camera on an arm that a rough road shakes. @param hertz its resonance.
inline Sway onArm(double size, double hertz, RNG& rng)
{
    const Oscillation oscillation(size, 1 / (1.4 * hertz), 1 / (0.6 * hertz), rng);
    return [oscillation](double seconds) { return oscillation.at(seconds); };
}

//! At random, without oscillating. @param memory seconds: integral of the correlation over the time that follows.
inline Sway wandering(double size, double memory, RNG& rng)
{
    // The correlation is (1 + t / s) exp(-t / s) with s = memory / 2.
    const double corner = 1 / (CV_PI * memory);
    const RandomSway random(
        size, 6 * corner, [=](double hertz) { return std::pow(1 + std::pow(hertz / corner, 2), -2); }, rng);
    return [random](double seconds) { return random.at(seconds); };
}

//! A drive through streets: bends, other speeds, walls that change, a suspension that tilts the car.
class StreetDrive
{
public:
    struct Options
    {
        Options()
            : yawRate(12 * CV_PI / 180), tilt(0.25 * CV_PI / 180), sway(oscillating), yawTilt(0), points(150), feet(0),
              segments(40), noise(0.3), endNoise(0.3), outliers(0.1), clutter(0.1), unevenness(0), rowsTurn(false),
              bend(0), lever(0)
        {
        }
        double yawRate;                         // rad/s, standard deviation
        double tilt;                            // radians, the same of roll and pitch of the suspension
        std::function<Sway(double, RNG&)> sway; // of that size
        double yawTilt;                         // the same of the camera's yaw against the car
        int points, feet;                       // of each frame; those at the feet of walls come to the others
        int segments;                           // of each frame
        double noise;                           // pixels, of a tracked point
        double endNoise;                        // pixels, of the ends of a segment
        double outliers, clutter;               // shares of points and of segments
        double unevenness; // 1/m, standard deviation of the points' inverse depth from that of their surface
        bool rowsTurn;     // whether the suspension tilts the car during the read-out as well
        double bend;       // rad/s, mean of the yaw rate
        double lever;      // metres from the rear axle to the camera
    };

    //! The views of a camera of the car and the measurements of the car at a time.
    struct Frame
    {
        double seconds;
        Mat points, segments;               // N x 4
        double yawRate, speed, roll, pitch; // true ones
    };

    StreetDrive(const cv::rsackermann::RollingShutterCamera& camera_, double roll_, double pitch_,
                const Options& options_, int seed)
        : camera(camera_), roll(roll_), pitch(pitch_), options(options_), rng(seed),
          yawRate(options.yawRate, 3, 10, rng), speed(2, 4, 20, rng), swayRoll(options.sway(options.tilt, rng)),
          swayPitch(options.sway(options.tilt, rng)),
          swayYaw(options.yawTilt > 0 ? options.sway(options.yawTilt, rng) : [](double) { return 0.; }),
          left(2, 4, 20, rng), right(2, 4, 20, rng), direction(0.05, 4, 20, rng)
    {
    }

    Frame frame(double seconds, double interval)
    {
        Frame f;
        f.seconds = seconds;
        f.yawRate = yawRateAt(seconds);
        f.speed = speedAt(seconds);
        f.roll = rollAt(seconds);
        f.pitch = pitchAt(seconds);
        const Simulator now = simulator(seconds), before = simulator(seconds - interval);
        std::vector<Vec4d> pairs;
        for (int i = 0; i < options.points; i++)
        {
            Vec4d pair;
            if (randomPoint(now, before, interval, pair))
                pairs.push_back(pair);
        }
        for (int i = 0; i < options.feet; i++)
        {
            Vec4d pair;
            if (randomFoot(now, before, interval, pair))
                pairs.push_back(pair);
        }
        f.points = Mat(int(pairs.size()), 4, CV_64F, pairs.data()).clone();
        SegmentOptions s;
        s.count = options.segments;
        s.noise = options.endNoise;
        s.inlierRatio = 1 - options.clutter;
        f.segments = randomSegments(now, s, rng).ends;
        return f;
    }

    //! What a gyro on the camera measures, rad/s about its axes.
    Vec3d rateAt(double seconds) const
    {
        return camera.uprightRotation.t() * Vec3d(-rateOf(swayPitch, seconds),
                                                  yawRateAt(seconds) + rateOf(swayYaw, seconds),
                                                  rateOf(swayRoll, seconds));
    }

private:
    static double rateOf(const Sway& sway, double seconds)
    {
        const double h = 1e-3;
        return (sway(seconds + h) - sway(seconds - h)) / (2 * h);
    }

    cv::rsackermann::RollingShutterCamera tilted(double seconds) const
    {
        cv::rsackermann::RollingShutterCamera c = camera;
        c.setRollPitch(rollAt(seconds), pitchAt(seconds));
        return c;
    }

    double rollAt(double seconds) const { return roll + swayRoll(seconds); }
    double pitchAt(double seconds) const { return pitch + swayPitch(seconds); }
    double yawRateAt(double seconds) const { return options.bend + yawRate.at(seconds); }
    double speedAt(double seconds) const { return 11 + speed.at(seconds); }

    Simulator simulator(double seconds) const
    {
        cv::rsackermann::RollingShutterCamera c = tilted(seconds);
        c.heading -= swayYaw(seconds);
        Simulator s = Simulator::fromMetric(c, yawRateAt(seconds), speedAt(seconds), 8 + left.at(seconds),
                                            8 + right.at(seconds), c.heading + direction.at(seconds));
        const double unit = c.secondsPerUnitTime(), h = 1e-3;
        s.drive.lever = options.lever * s.drive.speed / (speedAt(seconds) * unit); // in the unit of the street
        s.drive.yawChange = (yawRateAt(seconds + h) - yawRateAt(seconds - h)) / (2 * h) * unit * unit;
        if (options.rowsTurn)
            s.drive.shaking = [=](double t) {
                return Vec3d(rollAt(seconds + t * unit) - rollAt(seconds),
                             pitchAt(seconds + t * unit) - pitchAt(seconds),
                             swayYaw(seconds + t * unit) - swayYaw(seconds));
            };
        return s;
    }

    Point2d randomPixel()
    {
        return uniformPoint(rng, Point2d(0, 0), Point2d(camera.imageSize.width - 1, camera.imageSize.height - 1));
    }

    //! Where a pixel was in the frame before. @return its surface; nothing if it wasn't seen.
    Surface lookBack(const Simulator& now, const Simulator& before, double interval, const Point2d& pixel,
                     Point2d& past)
    {
        const double T = interval / now.camera.secondsPerUnitTime(), t = now.time(pixel);
        const Vec3d place = now.drive.position(t), ray = now.drive.turn(now.bearing(pixel), t);
        const Surface surface = now.street.first(place, ray);
        if (surface == NOTHING)
            return NOTHING;
        double inverse = 1 / now.street.distance(surface, place, ray);
        if (options.unevenness > 0)
            inverse += rng.gaussian(options.unevenness);
        // The camera of the frame before has its own tilt.
        Drive way = now.drive;
        const double yaw = before.camera.heading - now.camera.heading; // how the camera has shaken against the car
        way.shaking = [yaw](double) { return Vec3d(0, 0, -yaw); };
        const bool isSeen = inverse > 0 && before.project(way.toCamera(place + ray * (1 / inverse), -T), past);
        return isSeen ? surface : NOTHING;
    }

    //! A point on the road whose window shows a wall, too: it seems to move sideways as the wall above it.
    bool randomFoot(const Simulator& now, const Simulator& before, double interval, Vec4d& pair)
    {
        const double window = 6; // pixels to each side
        Point2d past, pastAbove;
        double wall = 0, road = camera.imageSize.height - 1, x = randomPixel().x; // rows
        while (road - wall > window / 10)
        {
            const double middle = (wall + road) / 2;
            (lookBack(now, before, interval, Point2d(x, middle), past) == ROAD ? road : wall) = middle;
        }
        const Point2d pixel(x, road + rng.uniform(0., window)), above(x, wall);
        const Surface surface = lookBack(now, before, interval, above, pastAbove);
        if ((surface != LEFT && surface != RIGHT) || lookBack(now, before, interval, pixel, past) != ROAD)
            return false;
        pair = Vec4d(pixel.x + pastAbove.x - above.x, past.y, pixel.x, pixel.y);
        return true;
    }

    bool randomPoint(const Simulator& now, const Simulator& before, double interval, Vec4d& pair)
    {
        const Point2d pixel = randomPixel();
        Point2d past;
        if (lookBack(now, before, interval, pixel, past) == NOTHING)
            return false;
        past += gaussianPoint(rng, options.noise);
        if (rng.uniform(0., 1.) < options.outliers)
            past += uniformPoint(rng, Point2d(-40, -20), Point2d(40, 20));
        pair = Vec4d(past.x, past.y, pixel.x, pixel.y);
        return true;
    }

    const cv::rsackermann::RollingShutterCamera camera;
    const double roll, pitch;
    const Options options;
    RNG rng;
    const Oscillation yawRate, speed;
    const Sway swayRoll, swayPitch, swayYaw;
    const Oscillation left, right, direction;
};

} // namespace simulation
} // namespace opencv_test

#endif // OPENCV_TEST_RSACKERMANN_DRIVE_SIMULATOR_HPP
