// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../scene/planes.hpp"
#include "inliers_and_scale.hpp"
#include "../camera/lens.hpp"
#include "../camera/line_delay_sigma.hpp"
#include "../factors/robust_losses.hpp"
#include "../factors/segment_residuals.hpp"

namespace cv { namespace rsackermann {

static const double AMBIGUOUS = 0.9; // correlation

void labelInliers(const std::vector<UprightSegment>& verticals, const Model& model, const Heading& heading,
                  const Agreement& agreement, AckermannMotion& motion, Mat& labels)
{
    motion.candidates = int(verticals.size());
    motion.inliers = 0;
    double sum = 0;
    for (size_t i = 0; i < verticals.size(); i++)
    {
        const UprightSegment& c = verticals[i];
        // Real verticals lean; their usual lean is no disagreement.
        const double leaning = SLANT_SCALE * agreement.focal * agreement.lean * norm(c.u - c.v),
                     threshold = std::max(agreement.threshold, leaning);
        int wall;
        const double r = agreement.focal * verticalResidual(c, model, heading, wall, 0);
        if (!(std::abs(r) < threshold))
            continue;
        labels.at<uchar>(c.index) = wall == Scene::RIGHT_WALL ? SEGMENT_RIGHT_WALL : SEGMENT_LEFT_WALL;
        motion.inliers++;
        sum += r * r;
    }
    motion.rms = motion.inliers > 0 ? std::sqrt(sum / motion.inliers) : 0;
}

static bool isRollYawAmbiguous(const Matx<double, PARAMETERS, PARAMETERS>& covariance)
{
    const double variances = covariance(P_ALPHA, P_ALPHA) * covariance(P_ROLL, P_ROLL);
    return variances > 0 && std::abs(covariance(P_ALPHA, P_ROLL)) > AMBIGUOUS * std::sqrt(variances);
}

void setModel(const Model& m, double G, const Matx<double, PARAMETERS, PARAMETERS>& covariance, AckermannMotion& motion)
{
    motion.alpha = m[P_ALPHA];
    motion.wallSlope = m[P_B];
    motion.wallOffset = m[P_D];
    motion.wallRatio = m[P_LAMBDA];
    motion.roadSlope = G;
    motion.direction = m.direction < 0 ? -1 : 1;
    motion.rollCorrection = m[P_ROLL];
    motion.pitchCorrection = m[P_PITCH];
    motion.covariance = covariance.get_minor<4, 4>(P_ALPHA, P_ALPHA);
    motion.rollYawAmbiguous = isRollYawAmbiguous(covariance);
}

void keepSeenWalls(const RollingShutterCamera& camera, AckermannMotion& motion)
{
    const double ratio = motion.wallRatio, B = motion.wallSlope, D = motion.wallOffset;
    if (!(ratio > 0))
        return;
    const Point2d last(camera.imageSize.width - 1, camera.imageSize.height - 1), middle = last * 0.5;
    const std::vector<Point2d> border = {Point2d(),
                                         Point2d(middle.x, 0),
                                         Point2d(last.x, 0),
                                         Point2d(0, middle.y),
                                         Point2d(last.x, middle.y),
                                         Point2d(0, last.y),
                                         Point2d(middle.x, last.y),
                                         last};
    bool seesLeft = false, seesRight = false;
    for (const Vec3d& ray : bearingsOf(camera, motion.uprightRotation(camera), border))
    {
        const double left = motion.direction * (D * ray[2] - B * ray[0]);
        seesLeft |= left > 0;
        seesRight |= left < 0;
    }
    if (seesLeft == seesRight)
        return;
    Matx44d J = Matx44d::diag(Vec4d(1, 1, 1, 0));
    if (seesRight)
    {
        motion.wallSlope = -ratio * B;
        motion.wallOffset = -ratio * D;
        J = Matx44d(1, 0, 0, 0, 0, -ratio, 0, -B, 0, 0, -ratio, -D, 0, 0, 0, 0);
    }
    motion.wallRatio = 0;
    motion.covariance = J * motion.covariance * J.t();
}

void setSpeedSigma(const RollingShutterCamera& camera, double wallLogSigma, AckermannMotion& motion)
{
    const Vec4d wall(0, motion.wallSlope, motion.wallOffset, 0);
    const double size = wall.dot(wall);
    double speed;
    if (!(size > 0) || !motion.speed(camera, speed))
        return;
    const double ofWall = std::sqrt(std::max(wall.dot(motion.covariance * wall), 0.)) / size;
    motion.speedSigma = std::abs(speed) * std::hypot(std::hypot(wallLogSigma, ofWall), relativeLineDelaySigma(camera));
}

bool setGivenScale(const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                   const MotionPrior& prior, AckermannMotion& motion)
{
    const double speed = std::hypot(motion.wallSlope, motion.wallOffset), unit = camera.secondsPerUnitTime();
    const bool hasSpeed =
        unit > 0 && prior.speedSigma > 0 && speed > 0 && prior.speed * motion.direction >= 0; // not with another sign
    if (params.wallDistance > 0 &&
        !(hasSpeed && prior.speedSigma < params.wallDistanceLogSigma * std::abs(prior.speed)))
    {
        motion.scale = SCALE_WALL;
        motion.wallDistance = params.wallDistance;
        if (params.wallDistanceLogSigma > 0)
            setSpeedSigma(camera, params.wallDistanceLogSigma, motion);
    }
    else if (hasSpeed)
    {
        motion.scale = SCALE_SPEED;
        motion.wallDistance = std::abs(prior.speed) * unit / speed;
        motion.speedSigma = prior.speedSigma;
    }
    return motion.scale != SCALE_UNKNOWN;
}

}} // namespace cv::rsackermann
