// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Undoes the rolling shutter of one image of a car's camera in several ways: in one call, with what the car says of its
// speed and yaw rate, step by step, and for points instead of the whole image. The program of the tutorials.

#include "opencv2/rsackermann.hpp"
#include "opencv2/core/utility.hpp"
#include "opencv2/imgcodecs.hpp"
#include "opencv2/imgproc.hpp"
#include "opencv2/opencv_modules.hpp"
#ifdef HAVE_OPENCV_FEATURES // goodFeaturesToTrack, from OpenCV 5 on
#include "opencv2/features.hpp"
#endif
#include <iostream>

using namespace cv;

static const char* const KEYS = "{help h     |           | print this message}"
                                "{@image     |           | raw image}"
                                "{@corrected | corrected.png | corrected image}"
                                "{@overlay   | overlay.png   | segments on the raw image}"
                                "{focal      | 0         | focal length in pixels; 0: 0.9 times the longer side}"
                                "{line_delay | 3.5e-5    | seconds between two rows}"
                                "{wall       | 2.5       | metres to the wall on the left}"
                                "{speed      | 60        | km/h, of the car's bus}"
                                "{yaw_rate   | 0         | deg/s, of the gyro}";

//! [correct]
static rsackermann::AckermannMotion correctFrame(const Mat& image, double focal, double lineDelay, Mat& corrected)
{
    rsackermann::RollingShutterCamera camera = rsackermann::RollingShutterCamera::fromFocal(image.size(), focal);
    camera.lineDelay = lineDelay;
    Ptr<rsackermann::RollingShutterCorrector> corrector = rsackermann::RollingShutterCorrector::create(camera);
    return corrector->correct(image, corrected);
}
//! [correct]

//! [prior]
static rsackermann::AckermannMotion correctWithSensors(const Mat& image,
                                                       const rsackermann::RollingShutterCamera& camera,
                                                       double wallDistance, double speed, double yawRate,
                                                       Mat& corrected)
{
    rsackermann::RollingShutterCorrector::Params params;
    params.estimator.wallDistance = wallDistance; // metres; without a length there is no speed in m/s
    Ptr<rsackermann::RollingShutterCorrector> corrector = rsackermann::RollingShutterCorrector::create(camera, params);

    rsackermann::MotionPrior prior;
    prior.speed = speed; // m/s
    prior.speedSigma = 2 / 3.6;
    prior.yawRate = yawRate; // rad/s
    prior.yawRateSigma = 1 * CV_PI / 180;
    corrector->setPrior(prior);
    return corrector->correct(image, corrected);
}
//! [prior]

//! [steps]
static void correctStepByStep(const Mat& image, const rsackermann::RollingShutterCamera& camera, Mat& corrected,
                              Mat& overlay)
{
    Mat segments, labels;
    const rsackermann::AckermannMotion motion =
        rsackermann::AckermannEstimator::create(camera)->estimateFromImage(image, segments, labels);

    Mat map1, map2, mask;
    rsackermann::WarpMapGenerator::create(camera)->initRectifyMap(motion, map1, map2, CV_16SC2, mask);
    remap(image, corrected, map1, map2, INTER_LINEAR);

    overlay = image.clone();
    rsackermann::drawMotion(overlay, segments, labels, camera, motion);
}
//! [steps]

//! [points]
static std::vector<Point2f> correctCorners(const Mat& image, const rsackermann::RollingShutterCamera& camera,
                                           const rsackermann::AckermannMotion& motion, std::vector<Point2f>& raw)
{
    Mat grey;
    cvtColor(image, grey, COLOR_BGR2GRAY);
    goodFeaturesToTrack(grey, raw, 200, 0.01, 10);
    std::vector<Point2f> corrected;
    rsackermann::WarpMapGenerator::create(camera)->correctPoints(motion, raw, corrected);
    return corrected;
}
//! [points]

static void print(const char* title, const rsackermann::AckermannMotion& motion,
                  const rsackermann::RollingShutterCamera& camera)
{
    //! [metric]
    double yawRate = 0, speed = 0;
    std::cout << title << ": status " << motion.status << ", " << motion.inliers << " of " << motion.candidates
              << " candidates agree";
    if (motion.yawRate(camera, yawRate))
        std::cout << ", " << yawRate * 180 / CV_PI << " deg/s";
    if (motion.speed(camera, speed))
        std::cout << ", " << speed * 3.6 << " km/h";
    std::cout << std::endl;
    //! [metric]
}

int main(int argc, const char** argv)
{
    CommandLineParser parser(argc, argv, KEYS);
    if (parser.has("help") || !parser.has("@image"))
    {
        parser.printMessage();
        return parser.has("help") ? 0 : 2;
    }
    const Mat image = imread(parser.get<String>("@image"), IMREAD_COLOR);
    if (image.empty())
    {
        std::cerr << parser.get<String>("@image") << " can't be read" << std::endl;
        return 1;
    }
    const double focal = parser.get<double>("focal"), lineDelay = parser.get<double>("line_delay");
    const double speed = parser.get<double>("speed") / 3.6, yawRate = parser.get<double>("yaw_rate") * CV_PI / 180;
    rsackermann::RollingShutterCamera camera = rsackermann::RollingShutterCamera::fromFocal(image.size(), focal);
    camera.lineDelay = lineDelay;

    Mat corrected, overlay;
    print("Without sensors", correctFrame(image, focal, lineDelay, corrected), camera);
    correctStepByStep(image, camera, corrected, overlay);
    const rsackermann::AckermannMotion motion =
        correctWithSensors(image, camera, parser.get<double>("wall"), speed, yawRate, corrected);
    print("With sensors", motion, camera);

    std::vector<Point2f> raw;
    const std::vector<Point2f> moved = correctCorners(image, camera, motion, raw);
    double sum = 0;
    for (size_t i = 0; i < raw.size(); i++)
        sum += norm(moved[i] - raw[i]);
    std::cout << raw.size() << " corners moved by " << (raw.empty() ? 0 : sum / double(raw.size())) << " px in the mean"
              << std::endl;

    imwrite(parser.get<String>("@corrected"), corrected);
    imwrite(parser.get<String>("@overlay"), overlay);
    return 0;
}
