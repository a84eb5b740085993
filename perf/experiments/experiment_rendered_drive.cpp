// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "experiment.hpp"
#include "options.hpp"
#include "rendered_drive.hpp"

#include "opencv2/imgcodecs.hpp"
#include <cstdio>

using namespace cv::rsackermann;
using namespace experiments;
using namespace rsackermann_samples;

namespace {

const char* const ABOUT =
    "Renders a drive (straight, a bend to and fro, a stop, a wall that ends, roll of the suspension) and measures what\n"
    "the correction leaves, frame by frame alone and as a drive, against the true correspondence; and how much the\n"
    "correction flickers.\n"
    "usage: rsackermann_experiment_rendered_drive [--option=value]...\n";

const char* const KEYS = "{help       |        | print this message}"
                         "{frames     | 300    | number of frames, 30 a second}"
                         "{seed       | 1      | of the street}"
                         "{stagger    | 1.5    | metres by which houses stand back}"
                         "{walls      |        | weave through a street whose walls come and go, instead}"
                         "{roll       | 0.5    | amplitude of the suspension's roll, which isn't given, degrees}"
                         "{save       |        | folder for the images}"
                         "{quiet      |        | print the summary only}"
                         "{threads    |        | number of threads}";

const double DEGREE = CV_PI / 180;

struct Series
{
    std::vector<double> raw, left, change; // pixels
    std::vector<cv::Point2d> before;       // error of the correction of the frame before
    std::vector<double> yawRate;           // errors in degrees a second, of the frames that tell one
    int within3;                           // of these

    Series() : within3(0) {}
};

// Adds what maps leave at the points of a grid.
void measure(const street::StreetRenderer& renderer, const cv::Mat maps[2], Series& series)
{
    const int step = 20;
    double raw = 0, left = 0, change = 0;
    int count = 0;
    std::vector<cv::Point2d> errors;
    for (int y = step / 2; y < maps[0].rows; y += step)
        for (int x = step / 2; x < maps[0].cols; x += step)
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

int run(const Options& options)
{
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 1024));
    street::StreetCamera eye(cv::Size(640, 380), 620, 0.025 / 380, 1.3);
    street::StreetScene scene;
    scene.seed = unsigned(options.integer("seed", 0, INT_MAX));
    scene.stagger = options.number("stagger", 0, 10);
    scene.clutter = 0.2;
    RenderedDrive drive(eye, scene);
    const double roll = options.number("roll", 0, 10) * DEGREE;
    drive.sway[0] = [roll](double seconds) { return roll * std::sin(2 * seconds) * std::cos(0.7 * seconds); };
    if (options.flag("walls"))
        drive.course = RenderedDrive::CHANGING_WALLS;
    const int frames = options.integer("frames", 2, 3000);
    const bool quiet = options.flag("quiet");

    RollingShutterCamera camera = RollingShutterCamera::fromFocal(eye.size, eye.fx);
    camera.lineDelay = eye.lineDelay;
    camera.height = eye.height;
    RollingShutterCorrector::Params params;
    const cv::Ptr<RollingShutterCorrector> alone = RollingShutterCorrector::create(camera, params);
    params.sequence = true;
    const cv::Ptr<RollingShutterCorrector> carried = RollingShutterCorrector::create(camera, params);
    Series series[2];
    for (int i = 0; i < frames; i++)
    {
        const street::StreetRenderer renderer = drive.next();
        const cv::Mat image = renderer.rollingShutter(2);
        if (options.given("save"))
            cv::imwrite(options.text("save") + cv::format("/%03d.jpg", i), image);
        cv::Mat corrected, maps[2][2];
        carried->setTimestamp(drive.seconds());
        for (int k = 0; k < 2; k++)
        {
            const AckermannMotion motion = (k == 0 ? alone : carried)->correct(image, corrected);
            (k == 0 ? alone : carried)->getMaps(maps[k][0], maps[k][1]);
            measure(renderer, maps[k], series[k]);
            double yawRate = 0;
            if (motion.status == MOTION_OK && motion.yawRate(camera, yawRate))
            {
                const double sigma = std::sqrt(motion.metricCovariance(camera)(0, 0));
                series[k].yawRate.push_back(std::abs(yawRate - drive.yawRate()) / DEGREE);
                series[k].within3 += std::abs(yawRate - drive.yawRate()) <= 3 * sigma;
            }
            if (!quiet)
                std::printf(
                    "%3d %s speed %5.1f yaw rate %6.2f found %6.2f status %d raw %.3f left %.3f expected %.3f %.3f\n",
                    i, k == 0 ? "alone  " : "carried", drive.speed(), drive.yawRate() / DEGREE, yawRate / DEGREE,
                    motion.status, series[k].raw.back(), series[k].left.back(), motion.expectedRaw,
                    motion.expectedResidual);
        }
    }
    summarise("alone", series[0]);
    summarise("carried", series[1]);
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
