// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// The valley of doc/theory.md, "Roll and yaw rate", on one rendered image.

#include "options.hpp"
#include "street_model.hpp"
#include "units.hpp"

#include "opencv2/rsackermann.hpp"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

using namespace cv::rsackermann;
using namespace rsackermann_samples;

namespace {

const char* const ABOUT =
    "Renders one image of a street and tells the estimator one roll and yaw rate after the other, as if both were\n"
    "exact. Writes a table (roll error in degrees, yaw rate in deg/s, px): the median of the distances between the\n"
    "columns of the two ends of an upright segment, after the correction by the motion and the walls that fit best.\n";

const char* const KEYS = "{help     |     | print this message}"
                         "{speed    | 40  | km/h}"
                         "{yaw_rate | 20  | deg/s}"
                         "{roll     | 2.5 | degrees, largest error of the given roll}"
                         "{extent   | 90  | deg/s, largest yaw rate that is given}"
                         "{steps    | 25  | of each to both sides}"
                         "{seed     | 0   | of the street}"
                         "{threads  |     | number of threads}";

RollingShutterCamera rolledBy(RollingShutterCamera camera, double roll)
{
    camera.setRollPitch(roll, 0);
    return camera;
}

// The segments that may be images of verticals if gravity is what it is.
cv::Mat uprightSegments(const RollingShutterCamera& camera, const cv::Mat& image)
{
    cv::Mat segments, labels, upright;
    AckermannEstimator::create(camera)->estimateFromImage(image, segments, labels);
    for (int i = 0; i < segments.rows; i++)
        if (labels.at<uchar>(i) != SEGMENT_REJECTED)
            upright.push_back(segments.row(i));
    return upright;
}

// Column in the upright frame of the global-shutter camera, pixels.
double uprightColumn(const RollingShutterCamera& camera, const cv::Point2f& p)
{
    const cv::Vec3d bearing = camera.uprightRotation * camera.cameraMatrix.inv() * cv::Vec3d(p.x, p.y, 1);
    return camera.cameraMatrix(0, 0) * bearing[0] / bearing[2];
}

double misfit(const RollingShutterCamera& camera, const cv::Mat& segments, double yawRate)
{
    AckermannEstimator::Params params;
    params.model = MODEL_4LA;
    params.gravitySigma = 0;
    params.maxYawRate = CV_PI;
    MotionPrior prior;
    prior.yawRate = yawRate;
    prior.yawRateSigma = 0.01 * DEGREE;
    const AckermannMotion motion = AckermannEstimator::create(camera, params)->estimate(segments, cv::noArray(), prior);

    const cv::Mat ends = segments.reshape(2, 2 * segments.rows);
    cv::Mat corrected;
    WarpMapGenerator::create(camera)->correctPoints(motion, ends, corrected);
    std::vector<double> distances(segments.rows);
    for (int i = 0; i < segments.rows; i++)
        distances[i] = std::abs(uprightColumn(camera, corrected.at<cv::Point2f>(2 * i)) -
                                uprightColumn(camera, corrected.at<cv::Point2f>(2 * i + 1)));
    std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
    return distances[distances.size() / 2];
}

int run(const Options& options)
{
    options.refuseArguments();
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 1024));
    const double roll = options.positive("roll", 45) * DEGREE, extent = options.positive("extent", 170) * DEGREE;
    const int steps = options.integer("steps", 1, 1000);

    const cv::Size size(640, 380);
    const street::StreetCamera streetCamera(size, 816, 0.4 / 30 / size.height, 1.2);
    street::StreetScene scene;
    scene.speed = options.number("speed", -500, 500) * KMH;
    scene.yawRate = options.number("yaw_rate", -170, 170) * DEGREE;
    scene.seed = unsigned(options.integer("seed", 0, 1 << 30));
    const RollingShutterCamera camera = libraryCamera(streetCamera);
    const cv::Mat segments = uprightSegments(camera, street::StreetRenderer(streetCamera, scene).rollingShutter());
    if (segments.empty())
        throw InputError("the street shows no upright segments");

    const int side = 2 * steps + 1;
    cv::Mat1d table(side, side);
    cv::parallel_for_(cv::Range(0, side), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; i++)
            for (int j = 0; j < side; j++)
                table(i, j) =
                    misfit(rolledBy(camera, roll * (i - steps) / steps), segments, extent * (j - steps) / steps);
    });
    for (int i = 0; i < side; i++, std::printf("\n"))
        for (int j = 0; j < side; j++)
            std::printf("%.4f %.4f %.4f\n", roll / DEGREE * (i - steps) / steps, extent / DEGREE * (j - steps) / steps,
                        table(i, j));
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
