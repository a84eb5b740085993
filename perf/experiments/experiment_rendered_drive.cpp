// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "experiment.hpp"
#include "options.hpp"
#include "rendered_drive.hpp"
#include "simulated_gyro.hpp"

#include "opencv2/imgcodecs.hpp"
#include <cstdio>
#include <memory>

using namespace cv::rsackermann;
using namespace experiments;
using namespace rsackermann_samples;

namespace {

const char* const ABOUT =
    "Renders a drive (straight, a bend to and fro, a stop, a wall that ends, roll of the suspension) and measures what\n"
    "the correction leaves, frame by frame alone, as a drive, and with the next frame, against the true correspondence;\n"
    "and how much the correction flickers. With --shake also by how much shaking alone moves the rows, and what is left with a gyro, as\n"
    "well.\n"
    "usage: rsackermann_experiment_rendered_drive [--option=value]...\n";

const char* const KEYS = "{help       |        | print this message}"
                         "{frames     | 300    | number of frames, 30 a second}"
                         "{seed       | 1      | of the street}"
                         "{stagger    | 1.5    | metres by which houses stand back}"
                         "{walls      |        | weave through a street whose walls come and go, instead}"
                         "{roll       | 0.5    | amplitude of the suspension's roll, which isn't given, degrees}"
                         "{shake      | none   | what shakes the camera: none, suspension, engine or phone}"
                         "{shake_rate |        | deg/s, root mean square of the pitch rate (default: 1.5, 5 or 11)}"
                         "{gyro_delay | 0.008  | seconds by which the gyro's clock is ahead, which isn't given}"
                         "{gyro_bias  | 0.5    | deg/s that the gyro shows too much about each axis}"
                         "{gyro_noise | 0.1    | deg/s, of each of 200 samples a second}"
                         "{save       |        | folder for the images}"
                         "{quiet      |        | print the summary only}"
                         "{threads    |        | number of threads}";

const double DEGREE = CV_PI / 180;
const int STEP = 20; // pixels between the points of the grid

struct Series
{
    std::vector<double> raw, left, change; // pixels
    std::vector<cv::Point2d> before;       // error of the correction of the frame before
    std::vector<double> yawRate;           // errors in degrees a second, of the frames that tell one
    int within3;                           // of these

    Series() : within3(0) {}
};

// Mean distance in pixels by which the shaking alone has moved the points of a grid.
double displacementByShaking(const street::StreetRenderer& renderer, street::StreetCamera camera,
                             const street::StreetScene& scene)
{
    camera.shake = camera.shake.heldAt(camera.seconds);
    const street::StreetRenderer held(camera, scene);
    double sum = 0;
    int count = 0;
    for (int y = STEP / 2; y < camera.size.height; y += STEP)
        for (int x = STEP / 2; x < camera.size.width; x += STEP)
        {
            cv::Point2d place, heldPlace;
            if (!renderer.toRolling(cv::Point2d(x, y), place) || !held.toRolling(cv::Point2d(x, y), heldPlace))
                continue;
            sum += cv::norm(place - heldPlace);
            count++;
        }
    return sum / std::max(count, 1);
}

// A frame of a drive, with what is true of it.
struct Shot
{
    explicit Shot(street::RenderedDrive& drive)
        : renderer(drive.next()), image(renderer.rollingShutter(2)), seconds(drive.seconds()), speed(drive.speed()),
          yawRate(street::turnRates(drive.camera(), drive.yawRate())[1]),
          shaken(displacementByShaking(renderer, drive.camera(), drive.street()))
    {
    }

    street::StreetRenderer renderer;
    cv::Mat image;
    double seconds, speed, yawRate; // m/s, rad/s
    double shaken;                  // pixels
};

// Adds what maps leave at the points of a grid.
void measure(const street::StreetRenderer& renderer, const cv::Mat maps[2], Series& series)
{
    double raw = 0, left = 0, change = 0;
    int count = 0;
    std::vector<cv::Point2d> errors;
    for (int y = STEP / 2; y < maps[0].rows; y += STEP)
        for (int x = STEP / 2; x < maps[0].cols; x += STEP)
        {
            const cv::Point2d p(x, y), q(maps[0].at<float>(y, x), maps[1].at<float>(y, x));
            cv::Point2d truth;
            const bool isSeen = renderer.toRolling(p, truth);
            errors.push_back(isSeen ? q - truth : cv::Point2d());
            if (!isSeen)
                continue;
            raw += cv::norm(p - truth);
            left += cv::norm(errors.back());
            if (!series.before.empty())
                change += (errors.back() - series.before[errors.size() - 1])
                              .dot(errors.back() - series.before[errors.size() - 1]);
            count++;
        }
    series.raw.push_back(raw / std::max(count, 1));
    series.left.push_back(left / std::max(count, 1));
    if (!series.before.empty())
        series.change.push_back(std::sqrt(change / std::max(count, 1)));
    series.before = errors;
}

void summarise(const char* name, const Series& s)
{
    double flicker = 0;
    for (double c : s.change)
        flicker += c * c / s.change.size();
    std::printf("%-8s raw %.3f left mean %.3f median %.3f p99 %.3f largest %.3f flicker %.3f px\n", name, mean(s.raw),
                mean(s.left), quantile(s.left, 0.5), quantile(s.left, 0.99), quantile(s.left, 1), std::sqrt(flicker));
    if (!s.yawRate.empty())
        std::printf(
            "%-8s yaw rate estimated in %d of %d frames: error median %.2f p99 %.2f deg/s, within 3 sigma %.1f %%\n",
            name, int(s.yawRate.size()), int(s.left.size()), quantile(s.yawRate, 0.5), quantile(s.yawRate, 0.99),
            100. * s.within3 / double(s.yawRate.size()));
}

street::Shake readShake(const Options& options)
{
    const int kind = options.choice("shake", street::Shake::words());
    const double rate =
        options.given("shake_rate") ? options.number("shake_rate", 0, 1000) * DEGREE : street::Shake::usualRate(kind);
    return street::Shake(kind, rate, unsigned(options.integer("seed", 0, INT_MAX)));
}

// Of all of a drive.
void addGyro(const Options& options, const street::RenderedDrive& drive, double end, RollingShutterCorrector& corrector)
{
    street::SimulatedGyro gyro;
    gyro.noise = options.number("gyro_noise", 0, 100) * DEGREE;
    gyro.bias = cv::Vec3d::all(options.number("gyro_bias", -10, 10) * DEGREE);
    gyro.delay = options.number("gyro_delay", -1, 1);
    gyro.seed = unsigned(options.integer("seed", 0, INT_MAX));
    cv::Mat times, rates;
    gyro.measure([&drive](double seconds) { return drive.ratesAt(seconds); }, -0.5, end + 0.5, times, rates);
    corrector.addGyro(times, rates);
}

int run(const Options& options)
{
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 1024));
    street::StreetCamera eye(cv::Size(640, 380), 620, 0.025 / 380, 1.3);
    street::StreetScene scene;
    scene.seed = unsigned(options.integer("seed", 0, INT_MAX));
    scene.stagger = options.number("stagger", 0, 10);
    scene.clutter = 0.2;
    scene.speed = 12;
    scene.yawRate = 10 * DEGREE;
    scene.left = 6;
    scene.right = 11;
    eye.shake = readShake(options);
    street::RenderedDrive drive(eye, scene);
    const double roll = options.number("roll", 0, 10) * DEGREE;
    drive.sway[0] = [roll](double seconds) { return roll * std::sin(2 * seconds) * std::cos(0.7 * seconds); };
    if (options.flag("walls"))
        drive.course = street::RenderedDrive::CHANGING_WALLS;
    const int frames = options.integer("frames", 2, 3000);
    const bool quiet = options.flag("quiet");

    RollingShutterCamera camera = RollingShutterCamera::fromFocal(eye.size, eye.fx);
    camera.setRollPitch(eye.roll, eye.pitch);
    camera.lineDelay = eye.lineDelay;
    camera.height = eye.height;
    RollingShutterCorrector::Params params;
    std::vector<cv::Ptr<RollingShutterCorrector>> correctors = {RollingShutterCorrector::create(camera, params)};
    params.sequence = true;
    correctors.push_back(RollingShutterCorrector::create(camera, params));
    correctors.push_back(RollingShutterCorrector::create(camera, params));
    if (eye.shake.kind() != street::Shake::NONE)
    {
        correctors.push_back(RollingShutterCorrector::create(camera, params));
        addGyro(options, drive, frames / street::RenderedDrive::framesPerSecond(), *correctors.back());
    }
    enum { ALONE, CARRIED, SMOOTH };
    const char* const names[] = {"alone", "carried", "smooth", "gyro"};
    std::vector<Series> series(correctors.size());
    std::vector<double> shaken; // pixels
    std::unique_ptr<Shot> next(new Shot(drive));
    for (int i = 0; i < frames; i++)
    {
        const std::unique_ptr<Shot> shot = std::move(next);
        next.reset(i + 1 < frames ? new Shot(drive) : nullptr);
        if (options.given("save"))
            cv::imwrite(options.text("save") + cv::format("/%03d.jpg", i), shot->image);
        shaken.push_back(shot->shaken);
        cv::Mat corrected, maps[2];
        for (size_t k = 0; k < correctors.size(); k++)
        {
            if (k != ALONE)
                correctors[k]->setTimestamp(shot->seconds);
            if (k == SMOOTH && next)
                correctors[k]->setNextFrame(next->image, next->seconds);
            const AckermannMotion motion = correctors[k]->correct(shot->image, corrected);
            correctors[k]->getMaps(maps[0], maps[1]);
            measure(shot->renderer, maps, series[k]);
            double yawRate = 0;
            if (motion.status == MOTION_OK && motion.yawRate(camera, yawRate))
            {
                const double sigma = std::sqrt(motion.metricCovariance(camera)(0, 0));
                series[k].yawRate.push_back(std::abs(yawRate - shot->yawRate) / DEGREE);
                series[k].within3 += std::abs(yawRate - shot->yawRate) <= 3 * sigma;
            }
            if (!quiet)
                std::printf(
                    "%3d %-7s speed %5.1f yaw rate %6.2f found %6.2f status %d raw %.3f left %.3f expected %.3f %.3f\n",
                    i, names[k], shot->speed, shot->yawRate / DEGREE, yawRate / DEGREE, motion.status,
                    series[k].raw.back(), series[k].left.back(), motion.expectedRaw, motion.expectedResidual);
        }
    }
    if (eye.shake.kind() != street::Shake::NONE)
        std::printf("shaking  mean %.3f p99 %.3f px\n", mean(shaken), quantile(shaken, 0.99));
    for (size_t k = 0; k < series.size(); k++)
        summarise(names[k], series[k]);
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
