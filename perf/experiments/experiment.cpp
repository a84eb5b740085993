// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "experiment.hpp"
#include "map_distance.hpp"

#include "opencv2/imgproc.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace experiments {

using namespace cv::rsackermann;
using namespace rsackermann_samples;

namespace {

const double NOT_KNOWN = std::numeric_limits<double>::quiet_NaN();

bool isAtRest(const street::StreetScene& scene)
{
    return scene.speed == 0 && scene.yawRate == 0;
}

// The camera as the estimator is given it.
RollingShutterCamera givenCamera(const street::StreetCamera& truth, const Knowledge& knowledge, cv::RNG& rng)
{
    if (!knowledge.camera)
        return RollingShutterCamera::fromFocal(truth.size);
    street::StreetCamera given = truth;
    given.roll += rng.gaussian(knowledge.rollNoise);
    given.pitch += rng.gaussian(knowledge.pitchNoise);
    const double focalError =
        knowledge.focalError + (knowledge.focalNoise > 0 ? rng.gaussian(knowledge.focalNoise) : 0);
    given.fx *= 1 + focalError;
    given.fy *= 1 + focalError;
    RollingShutterCamera camera = libraryCamera(given);
    camera.focalSigma = knowledge.focalNoise * given.fx;
    return camera;
}

// The motion as the estimator is given it.
MotionPrior givenMotion(const street::StreetScene& truth, const Knowledge& knowledge, cv::RNG& rng)
{
    MotionPrior prior;
    const double error = knowledge.exactPriors ? 0 : 1;
    prior.speed = truth.speed + rng.gaussian(error * knowledge.speedSigma);
    prior.speedSigma = knowledge.speedSigma;
    prior.yawRate = truth.yawRate + rng.gaussian(error * knowledge.yawRateSigma);
    prior.yawRateSigma = knowledge.yawRateSigma;
    prior.wallDirection = truth.wallDirection + rng.gaussian(error * knowledge.wallDirectionSigma);
    prior.wallDirectionSigma = knowledge.wallDirectionSigma;
    return prior;
}

double sigmaOf(double variance, double unit)
{
    return variance > 0 ? std::sqrt(variance) / unit : NOT_KNOWN;
}

// The segments of the global-shutter image with their ends where the rolling shutter shows them.
cv::Mat exactSegments(const Case& c, const AckermannEstimator::Params& params)
{
    const cv::Mat image = c.photo.empty() ? street::StreetRenderer(c.camera, c.scene).globalShutter() : c.photo;
    cv::Mat segments, moved;
    detectSegments(image, segments, params.detector, params.minLength);
    WarpMapGenerator::create(libraryCamera(c.camera))
        ->distortPoints(libraryMotion(c.camera, c.scene), segments.reshape(2, segments.rows * 2), moved);
    return moved.reshape(1, segments.rows);
}

// The segments that the largest slant allows to be vertical in the scene.
cv::Mat verticalOnes(const cv::Mat& segments, double maxSlant)
{
    cv::Mat verticals(0, 4, CV_32F);
    for (int i = 0; i < segments.rows; i++)
    {
        const cv::Vec4f s = segments.at<cv::Vec4f>(i);
        if (std::abs(s[0] - s[2]) <= maxSlant * std::abs(s[1] - s[3]))
            verticals.push_back(segments.row(i));
    }
    return verticals;
}

// Mean displacement that errors with the motion's covariance would leave, by the maps of motions drawn with it.
double predictedDisplacement(const RollingShutterCamera& camera, const AckermannMotion& motion, const cv::Mat maps[2],
                             const cv::Mat& mask, int samples, cv::RNG& rng)
{
    cv::Mat values, vectors;
    cv::eigen(cv::Mat(motion.covariance), values, vectors);
    double sum = 0;
    for (int i = 0; i < samples; i++)
    {
        cv::Vec4d change;
        for (int k = 0; k < 4; k++)
        {
            const double size = rng.gaussian(std::sqrt(std::max(0., values.at<double>(k))));
            change += size * cv::Vec4d(vectors.ptr<double>(k));
        }
        AckermannMotion other = motion;
        other.alpha += change[0];
        other.wallSlope += change[1];
        other.wallOffset += change[2];
        other.wallRatio = std::max(other.wallRatio + change[3], 0.);
        const double size = std::hypot(motion.wallSlope, motion.wallOffset);
        other.roadSlope *= size > 0 ? std::hypot(other.wallSlope, other.wallOffset) / size : 1;
        cv::Mat changed[2];
        WarpMapGenerator::create(camera)->initRectifyMap(other, changed[0], changed[1]);
        sum += meanDistance(changed[0], changed[1], maps[0], maps[1], mask);
    }
    return sum / samples;
}

// A mask of what is next to edges that are more than noise: displacements can be seen there alone.
cv::Mat structureOf(const cv::Mat& image)
{
    const double visible = 60; // square of Sobel's derivative, of a contrast that can be seen
    cv::Mat gray, x, y, energy;
    cv::GaussianBlur(image, gray, cv::Size(), 1.5);
    if (gray.channels() > 1)
        cv::cvtColor(gray, gray, cv::COLOR_BGR2GRAY);
    cv::Sobel(gray, x, CV_32F, 1, 0);
    cv::Sobel(gray, y, CV_32F, 0, 1);
    energy = x.mul(x) + y.mul(y);
    cv::GaussianBlur(energy, energy, cv::Size(), 4);
    std::vector<float> sorted(energy.begin<float>(), energy.end<float>());
    const size_t lowest = sorted.size() / 20;
    std::nth_element(sorted.begin(), sorted.begin() + lowest, sorted.end());
    return energy > visible + 3 * sorted[lowest];
}

} // namespace

cv::Mat makeImage(const Case& c)
{
    if (c.photo.empty())
        return street::StreetRenderer(c.camera, c.scene).rollingShutter();
    if (isAtRest(c.scene))
        return c.photo;
    cv::Mat columns, rows, image;
    const AckermannMotion motion = libraryMotion(c.camera, c.scene);
    WarpMapGenerator::create(libraryCamera(c.camera))->initDistortMap(motion, columns, rows);
    // A black border would show false edges: what the photograph doesn't show is mirrored.
    cv::remap(c.photo, image, columns, rows, cv::INTER_CUBIC, cv::BORDER_REFLECT_101);
    return image;
}

Result evaluate(const Case& c, const cv::Mat& image, const Experiment& experiment, unsigned seed)
{
    const Knowledge& knowledge = experiment.knowledge;
    const AckermannEstimator::Params& params = experiment.params;
    cv::RNG rng(seed * 7717u + 1);
    rng.next(); // the first normal deviate of a small seed is 0
    const RollingShutterCamera camera = givenCamera(c.camera, knowledge, rng);
    const MotionPrior prior = givenMotion(c.scene, knowledge, rng);
    cv::Mat segments;
    if (experiment.segments.exact)
        segments = exactSegments(c, params);
    else
        detectSegments(image, segments, params.detector, params.minLength);
    if (experiment.segments.verticalsOnly)
        segments = verticalOnes(segments, params.maxSlant);
    const AckermannMotion motion = AckermannEstimator::create(camera, params)->estimate(segments, cv::noArray(), prior);

    cv::Mat identity[2], truth[2], estimated[2], mask;
    identityMaps(c.camera.size, identity[0], identity[1]);
    street::StreetRenderer(c.camera, c.scene).rectifyMap(truth[0], truth[1], mask);
    WarpMapGenerator::create(camera)->initRectifyMap(motion, estimated[0], estimated[1]);

    Result result;
    result.status = motion.status;
    result.model = motion.model;
    result.candidates = motion.candidates;
    result.inliers = motion.inliers;
    result.raw = meanDistance(identity[0], identity[1], truth[0], truth[1], mask);
    result.left = meanDistance(estimated[0], estimated[1], truth[0], truth[1], mask);

    const cv::Mat seen = mask & structureOf(image);
    result.seenLeft = meanDistance(estimated[0], estimated[1], truth[0], truth[1], seen);
    result.expectedResidual = motion.expectedResidual;
    result.probabilityWorse = motion.probabilityWorse;

    double yawRate = 0, speed = 0;
    const bool ok = motion.status == MOTION_OK;
    result.yawRateError = motion.yawRate(camera, yawRate) ? (yawRate - c.scene.yawRate) * 180 / CV_PI : NOT_KNOWN;
    result.speedError = !ok                           ? -c.scene.speed * 3.6
                        : motion.speed(camera, speed) ? (speed - c.scene.speed) * 3.6
                                                      : NOT_KNOWN;
    // The walls of a camera that looks to a side have their vanishing point far outside of the image.
    const bool ahead = std::cos(c.scene.wallDirection) > 0.5;
    result.deltaError = ok && ahead && motion.wallSlope != 0
                            ? (motion.delta() - std::tan(c.scene.wallDirection)) * c.camera.fx
                            : NOT_KNOWN;
    const cv::Matx44d covariance = motion.metricCovariance(camera);
    result.yawRateSigma = ok ? sigmaOf(covariance(0, 0), CV_PI / 180) : NOT_KNOWN;
    result.speedSigma = ok ? sigmaOf(covariance(1, 1), 1 / 3.6) : NOT_KNOWN;
    result.floor = ok && experiment.floorSamples > 0
                       ? predictedDisplacement(camera, motion, estimated, mask, experiment.floorSamples, rng)
                       : NOT_KNOWN;
    return result;
}

void setGravitySigma(double sigma, AckermannEstimator::Params& params)
{
    params.gravitySigma = sigma;
    if (sigma > 0)
        params.vehiclePitchSigma = sigma;
}

double quantile(std::vector<double> values, double fraction)
{
    values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }), values.end());
    if (values.empty())
        return NOT_KNOWN;
    std::sort(values.begin(), values.end());
    const double at = fraction * (values.size() - 1);
    const size_t i = size_t(at), next = std::min(i + 1, values.size() - 1);
    return values[i] + (at - i) * (values[next] - values[i]);
}

double mean(const std::vector<double>& values)
{
    double sum = 0;
    int count = 0;
    for (double v : values)
        if (!std::isnan(v))
        {
            sum += v;
            count++;
        }
    return count ? sum / count : NOT_KNOWN;
}

} // namespace experiments
