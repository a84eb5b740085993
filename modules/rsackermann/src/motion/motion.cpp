// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/line_delay_sigma.hpp"
#include "../checks.hpp"
#include "compensation.hpp"
#include "metric_way.hpp"
#include "row_tilt.hpp"
#include "../scene/inverse_depth_offset.hpp"
#include "../storage.hpp"

namespace cv { namespace rsackermann {

AckermannMotion::AckermannMotion()
    : status(MOTION_NOT_SIGNIFICANT), model(MODEL_NONE), alpha(0), wallSlope(0), wallOffset(0), wallRatio(0),
      roadSlope(0), direction(1), pitchRate(0), rollRate(0), pitchRateSigma(0), rollRateSigma(0), rollCorrection(0),
      pitchCorrection(0), headingCorrection(0), wallDistance(0), scale(SCALE_UNKNOWN), speedSigma(0),
      covariance(Matx44d::zeros()), rollYawAmbiguous(false), contradictsPrior(false), seenYawRate(0),
      seenYawRateSigma(0), seenSpeed(0), seenSpeedSigma(0), readoutRatio(1), readoutRatioSigma(0), seenHeading(0),
      seenHeadingSigma(0), candidates(0), inliers(0), rms(0), expectedRaw(0), expectedResidual(0), probabilityWorse(0)
{
}

MetricMotion::MetricMotion()
    : yawRate(0), pitchRate(0), rollRate(0), speed(0), leftDistance(0), rightDistance(0), wallDirection(0)
{
}

AckermannMotion AckermannMotion::fromMetric(const RollingShutterCamera& camera, const MetricMotion& metric)
{
    camera.check();
    const double left = metric.leftDistance, right = metric.rightDistance;
    REJECT_IF(!(camera.lineDelay > 0), "camera.lineDelay is %g s; metric values need a positive one", camera.lineDelay);
    checkFinite(metric.yawRate, "metric.yawRate");
    checkFinite(metric.pitchRate, "metric.pitchRate");
    checkFinite(metric.rollRate, "metric.rollRate");
    checkFinite(metric.speed, "metric.speed");
    checkNotNegative(left, "metric.leftDistance", "no left wall");
    checkNotNegative(right, "metric.rightDistance", "no right wall");
    checkAngle(metric.wallDirection, "metric.wallDirection");
    REJECT_IF(metric.speed != 0 && left == 0 && right == 0 && camera.height == 0,
              "metric.speed is %g m/s, but camera.height, metric.leftDistance and metric.rightDistance are 0; one of "
              "them has to be positive, as the speed is kept by the unit of length that it gives",
              metric.speed);

    // doc/theory.md, "Depth": the wall along (sin, cos) of wallDirection has the normal (-cos, sin) on the left.
    AckermannMotion m;
    m.alpha = metric.yawRate * camera.secondsPerUnitTime() / 2;
    m.pitchRate = metric.pitchRate * camera.secondsPerUnitTime();
    m.rollRate = metric.rollRate * camera.secondsPerUnitTime();
    const double beta = metric.speed * camera.secondsPerUnitTime();
    m.direction = metric.speed < 0 ? -1 : 1;
    m.wallDistance = left > 0 ? left : right;
    if (m.wallDistance > 0)
    {
        const double scale = left > 0 ? beta / left : -beta / right;
        m.wallSlope = scale * std::cos(metric.wallDirection);
        m.wallOffset = scale * std::sin(metric.wallDirection);
    }
    m.scale = m.wallDistance > 0 ? SCALE_WALL : camera.height > 0 ? SCALE_ROAD : SCALE_UNKNOWN;
    if (left > 0 && right > 0)
        m.wallRatio = left / right;
    if (camera.height > 0)
        m.roadSlope = beta / camera.height;
    const bool turns = metric.yawRate != 0 || metric.pitchRate != 0 || metric.rollRate != 0;
    m.model = metric.speed == 0 ? (turns ? MODEL_1LA : MODEL_NONE) : (metric.yawRate == 0 ? MODEL_3LA : MODEL_4LA);
    m.status = m.model == MODEL_NONE ? MOTION_NOT_SIGNIFICANT : MOTION_OK;
    return m;
}

double AckermannMotion::delta() const
{
    return std::abs(wallSlope) > 1e-9 * std::abs(wallOffset) ? wallOffset / wallSlope : 0;
}

bool AckermannMotion::yawRate(const RollingShutterCamera& camera, double& radiansPerSecond) const
{
    const double unit = camera.secondsPerUnitTime();
    const bool known = unit > 0 && (status == MOTION_OK || status == MOTION_NOT_SIGNIFICANT);
    radiansPerSecond = known ? 2 * alpha / unit : 0;
    return known;
}

bool AckermannMotion::speed(const RollingShutterCamera& camera, double& metresPerSecond) const
{
    const double unit = camera.secondsPerUnitTime();
    double way;
    const bool known = findWayPerUnitTime(camera, *this, way) && unit > 0;
    metresPerSecond = known ? way / unit : 0;
    return known;
}

Matx44d AckermannMotion::metricCovariance(const RollingShutterCamera& camera) const
{
    // Derivatives of (yaw rate, speed, delta, wallRatio) by (alpha, wallSlope, wallOffset, wallRatio).
    const double B = wallSlope, D = wallOffset;
    const double unit = camera.secondsPerUnitTime(), size = std::hypot(B, D);
    Matx44d J = Matx44d::zeros();
    if (unit > 0)
        J(0, 0) = 2 / unit;
    if (unit > 0 && wallDistance > 0 && size > 0 && !(speedSigma > 0))
    {
        J(1, 1) = direction * B / size * wallDistance / unit;
        J(1, 2) = direction * D / size * wallDistance / unit;
    }
    // What moves less has no direction: the derivatives, or their squares, would be infinite
    const double slowest = 1e-100;
    if (std::abs(B) > 1e-9 * std::abs(D) && size > slowest)
    {
        J(2, 1) = -D / (B * B);
        J(2, 2) = 1 / B;
    }
    J(3, 3) = 1;
    Vec4d perSecond;
    yawRate(camera, perSecond[0]);
    double ofSpeed = 0;
    if (speed(camera, perSecond[1]) && (scale == SCALE_SPEED || speedSigma > 0))
    {
        ofSpeed = speedSigma;
        perSecond[1] = 0; // the speed gives the metres, whatever the line delay
    }
    const Vec4d change = relativeLineDelaySigma(camera) * perSecond;
    Matx44d result = J * covariance * J.t() + change * change.t();
    result(1, 1) += ofSpeed * ofSpeed;
    return result;
}

Matx33d AckermannMotion::uprightRotation(const RollingShutterCamera& camera) const
{
    return tiltRotation(rollCorrection, pitchCorrection) * camera.uprightRotation;
}

double AckermannMotion::heading(const RollingShutterCamera& camera) const
{
    return camera.heading + headingCorrection;
}

void AckermannMotion::pose(const RollingShutterCamera& camera, double time, Matx33d& R, Vec3d& T) const
{
    checkFinite(time, "time");
    // doc/theory.md, "Motion"
    const RowMotion row(alpha, heading(camera), time);
    const Matx33d upright = uprightRotation(camera);
    R = upright.t() * yawRotation(2 * alpha * time) * RowTilt(camera, *this).at(time) * upright;
    const bool translates = wallSlope != 0 || wallOffset != 0 || roadSlope != 0 || !inverseDepthOffset.empty();
    T = translates ? upright.t() * Vec3d(row.s2, 0, row.c2) * (direction * row.tau) : Vec3d();
}

void AckermannMotion::write(FileStorage& fs) const
{
    fs << "status" << status << "model" << model;
    fs << "alpha" << alpha << "wall_slope" << wallSlope << "wall_offset" << wallOffset << "wall_ratio" << wallRatio;
    fs << "road_slope" << roadSlope << "direction" << direction;
    fs << "pitch_rate" << pitchRate << "roll_rate" << rollRate << "pitch_rate_sigma" << pitchRateSigma
       << "roll_rate_sigma" << rollRateSigma;
    fs << "roll_correction" << rollCorrection << "pitch_correction" << pitchCorrection << "heading_correction"
       << headingCorrection << "wall_distance" << wallDistance;
    fs << "scale" << scale << "speed_sigma" << speedSigma << "expected_raw" << expectedRaw << "expected_residual"
       << expectedResidual;
    fs << "probability_worse" << probabilityWorse;
    fs << "offset_area" << offsetArea;
    if (!inverseDepthOffset.empty())
        fs << "inverse_depth_offset" << inverseDepthOffset;
    if (!rotationCurve.empty())
        fs << "rotation_curve" << rotationCurve;
    fs << "covariance" << covariance << "roll_yaw_ambiguous" << rollYawAmbiguous;
    fs << "contradicts_prior" << contradictsPrior << "seen_yaw_rate" << seenYawRate << "seen_yaw_rate_sigma"
       << seenYawRateSigma << "seen_speed" << seenSpeed << "seen_speed_sigma" << seenSpeedSigma << "readout_ratio"
       << readoutRatio << "readout_ratio_sigma" << readoutRatioSigma << "seen_heading" << seenHeading
       << "seen_heading_sigma" << seenHeadingSigma;
    fs << "candidates" << candidates << "inliers" << inliers << "rms" << rms;
}

// A size or type that is none of those that are possible is refused before OpenCV takes the memory for it.
template <class Possible>
static Mat readValues(const FileNode& fn, const char* key)
{
    Mat values; // copies of the motion keep theirs
    const FileNode node = fn[key];
    if (node.empty())
        return values;
    const Size stored = storedSize(node);
    const String type = node.isMap() ? String(node["dt"]) : String();
    REJECT_IF(!Possible::isPossible(stored) || type != "d",
              "%s is %d x %d of type \"%s\"; %s of type \"d\" are expected", key, stored.height, stored.width,
              type.c_str(), Possible::possibleSizes().c_str());
    cv::read(node, values);
    return values;
}

static void readOffset(const FileNode& fn, Mat& offset, Rect2d& area)
{
    if (fn["offset_area"].empty() && fn["inverse_depth_offset"].empty())
        return;
    offset = readValues<InverseDepthOffset>(fn, "inverse_depth_offset");
    cv::read(fn["offset_area"], area, area);
}

void AckermannMotion::read(const FileNode& fn)
{
    readFields(fn, "status", status, "model", model, "alpha", alpha, "wall_slope", wallSlope);
    readFields(fn, "wall_offset", wallOffset, "wall_ratio", wallRatio, "road_slope", roadSlope, "direction", direction);
    readFields(fn, "pitch_rate", pitchRate, "roll_rate", rollRate, "pitch_rate_sigma", pitchRateSigma);
    readFields(fn, "roll_rate_sigma", rollRateSigma, "roll_correction", rollCorrection);
    readFields(fn, "pitch_correction", pitchCorrection, "heading_correction", headingCorrection, "wall_distance",
               wallDistance, "scale", scale);
    readFields(fn, "speed_sigma", speedSigma);
    readFields(fn, "expected_raw", expectedRaw, "expected_residual", expectedResidual);
    readFields(fn, "probability_worse", probabilityWorse);
    readMatrix(fn, "covariance", covariance);
    readOffset(fn, inverseDepthOffset, offsetArea);
    if (!fn["pitch_rate"].empty() || !fn["rotation_curve"].empty())
        rotationCurve = readValues<RotationCurve>(fn, "rotation_curve");
    readFields(fn, "roll_yaw_ambiguous", rollYawAmbiguous, "contradicts_prior", contradictsPrior);
    readFields(fn, "seen_yaw_rate", seenYawRate, "seen_yaw_rate_sigma", seenYawRateSigma, "seen_speed", seenSpeed);
    readFields(fn, "readout_ratio", readoutRatio, "readout_ratio_sigma", readoutRatioSigma);
    readFields(fn, "seen_heading", seenHeading, "seen_heading_sigma", seenHeadingSigma);
    readFields(fn, "seen_speed_sigma", seenSpeedSigma, "candidates", candidates, "inliers", inliers, "rms", rms);
}

static void checkOffset(const AckermannMotion& motion)
{
    const Mat& offset = motion.inverseDepthOffset;
    const Rect2d& area = motion.offsetArea;
    if (offset.empty())
        return;
    REJECT_IF(offset.dims != 2 || offset.type() != CV_64FC1 || !InverseDepthOffset::isPossible(offset.size()),
              "motion.inverseDepthOffset is a %d x %d matrix of type %s; %s of type CV_64FC1 are expected", offset.rows,
              offset.cols, typeToString(offset.type()).c_str(), InverseDepthOffset::possibleSizes().c_str());
    REJECT_IF(
        !cv::checkRange(offset, true, 0, -LARGEST_VALUE, LARGEST_VALUE),
        "motion.inverseDepthOffset has values that aren't finite or beyond +-%g; finite ones up to it are expected",
        LARGEST_VALUE);
    checkFinite(area.x, "motion.offsetArea.x");
    checkFinite(area.y, "motion.offsetArea.y");
    checkPositive(area.width, "motion.offsetArea.width");
    checkPositive(area.height, "motion.offsetArea.height");
}

static void checkWords(const AckermannMotion& motion)
{
    REJECT_IF(motion.status < MOTION_OK || motion.status > MOTION_NOT_OBSERVABLE,
              "motion.status is %d; one of the MotionStatus values 0 to 4 is expected", motion.status);
    const int model = motion.model;
    REJECT_IF(model != MODEL_NONE && model != MODEL_1LA && model != MODEL_3LA && model != MODEL_4LA,
              "motion.model is %d; one of the MotionModel values 0, 1, 3 and 4 is expected", model);
    REJECT_IF(motion.direction != 1 && motion.direction != -1,
              "motion.direction is %d; 1 (forward) or -1 (reverse) is expected", motion.direction);
    REJECT_IF(motion.scale < SCALE_UNKNOWN || motion.scale > SCALE_SPEED,
              "motion.scale is %d; one of the MotionScale values 0 to 3 is expected", motion.scale);
}

void checkMotion(const AckermannMotion& motion)
{
    checkWords(motion);
    checkOffset(motion);
    const double values[] = {
        motion.alpha,           motion.wallSlope,         motion.wallOffset,  motion.wallRatio,
        motion.roadSlope,       motion.pitchRate,         motion.rollRate,    motion.rollCorrection,
        motion.pitchCorrection, motion.headingCorrection, motion.wallDistance};
    const char* const names[] = {"alpha",           "wallSlope",         "wallOffset",  "wallRatio",
                                 "roadSlope",       "pitchRate",         "rollRate",    "rollCorrection",
                                 "pitchCorrection", "headingCorrection", "wallDistance"};
    const double largest = 1e150; // the walls' inverse depths, products of two of them, are finite
    for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++)
        REJECT_IF(!(std::abs(values[i]) <= largest), "motion.%s is %g; a number from %g to %g is expected", names[i],
                  values[i], -largest, largest);
}

MotionPrior::MotionPrior()
    : speed(0), speedSigma(0), yawRate(0), yawRateSigma(0), wallDirection(0), wallDirectionSigma(0)
{
}

void MotionPrior::check() const
{
    checkFinite(speed, "prior.speed");
    checkNotNegative(speedSigma, "prior.speedSigma", "not known");
    checkFinite(yawRate, "prior.yawRate");
    checkNotNegative(yawRateSigma, "prior.yawRateSigma", "not known");
    checkAngle(wallDirection, "prior.wallDirection");
    checkNotNegative(wallDirectionSigma, "prior.wallDirectionSigma", "not known");
}

void MotionPrior::write(FileStorage& fs) const
{
    fs << "speed" << speed << "speed_sigma" << speedSigma << "yaw_rate" << yawRate << "yaw_rate_sigma" << yawRateSigma;
    fs << "wall_direction" << wallDirection << "wall_direction_sigma" << wallDirectionSigma;
}

void MotionPrior::read(const FileNode& fn)
{
    readFields(fn, "speed", speed, "speed_sigma", speedSigma, "yaw_rate", yawRate, "yaw_rate_sigma", yawRateSigma);
    readFields(fn, "wall_direction", wallDirection, "wall_direction_sigma", wallDirectionSigma);
}

}} // namespace cv::rsackermann
