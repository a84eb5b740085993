// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/lens.hpp"
#include "../checks.hpp"
#include "../features/segments.hpp"
#include "../storage.hpp"
#include "../motion/contradiction.hpp"
#include "inliers_and_scale.hpp"
#include "posterior.hpp"

namespace cv { namespace rsackermann {

// A first guess for other segments than verticals: the noise of the image is measured.
static const double FIRST_OTHERS_SIGMA = 1; // pixels

namespace {

class AckermannEstimatorImpl CV_FINAL : public StatelessAlgorithm<AckermannEstimator>
{
public:
    AckermannEstimatorImpl(const RollingShutterCamera& camera_, const Params& params_)
        : StatelessAlgorithm<AckermannEstimator>(camera_, params_)
    {
    }

    AckermannMotion estimate(InputArray segments, OutputArray labels, const MotionPrior& prior) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        return runAndCompare(segmentRows(segments), labels, prior);
    }

    AckermannMotion estimateFromImage(InputArray image, OutputArray segments, OutputArray labels,
                                      const MotionPrior& prior) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        checkImage(image, "image", camera.imageSize);
        Mat found;
        detectSegments(image, found, params.detector, params.minLength);
        if (segments.needed())
            returnSegments(found, segments);
        return runAndCompare(segmentRows(found), labels, prior);
    }

    String getDefaultName() const CV_OVERRIDE { return "rsackermann_AckermannEstimator"; }

private:
    AckermannMotion runAndCompare(const Mat& segments, OutputArray labels, const MotionPrior& prior) const;
    AckermannMotion run(const Mat& segments, OutputArray labels, const MotionPrior& prior) const;
    RefinementProblem makeProblem(const MotionLimits& limits) const;
    int findMotion(RefinementProblem& problem, Posterior& found, AckermannMotion& motion, Mat& labels) const;
    void report(const RefinementProblem& problem, const MotionPrior& prior, const Posterior& found,
                AckermannMotion& motion) const;
};

// The azimuth's tangent of a pixel, in the upright frame.
static double uprightColumn(const RollingShutterCamera& camera, const Point2d& pixel)
{
    std::vector<Point2d> rays;
    undistortedRays(camera, std::vector<Point2d>(1, pixel), rays);
    const Vec3d bearing = camera.uprightRotation * Vec3d(rays[0].x, rays[0].y, 1);
    return bearing[0] / bearing[2];
}

RefinementProblem AckermannEstimatorImpl::makeProblem(const MotionLimits& limits) const
{
    RefinementProblem problem(limits);
    problem.uprightRotation = camera.uprightRotation;
    problem.distortionSigma = camera.distortionSigma;
    problem.heading = camera.heading;
    problem.focal = camera.cameraMatrix(0, 0);
    problem.sigma = END_SIGMA;
    problem.directionSigma = FIRST_OTHERS_SIGMA;
    const bool isExact = !(params.gravitySigma > 0);
    problem.gravitySigma = isExact ? EXACT_GRAVITY : params.gravitySigma;
    problem.vehiclePitchSigma = isExact ? EXACT_GRAVITY : params.vehiclePitchSigma;
    problem.streetDeviation = params.wallDeviationSigma;
    const double middle = (camera.imageSize.height - 1) / 2.;
    problem.leftmost = uprightColumn(camera, Point2d(0, middle));
    problem.rightmost = uprightColumn(camera, Point2d(camera.imageSize.width - 1, middle));
    return problem;
}

// The estimate is near a given value whatever the image shows: a contradiction shows without the values alone, since
// one that is wrong would make the other one look so.
AckermannMotion AckermannEstimatorImpl::runAndCompare(const Mat& segments, OutputArray labels,
                                                      const MotionPrior& prior) const
{
    AckermannMotion motion = run(segments, labels, prior);
    const bool isGiven = prior.yawRateSigma > 0 || prior.speedSigma > 0;
    if (!isGiven || !(camera.lineDelay > 0) || (motion.status != MOTION_OK && motion.status != MOTION_NOT_SIGNIFICANT))
        return motion;
    // What is seen decides, not how seldom cars reverse, or drive or turn as fast as is given.
    AckermannEstimatorImpl neutral(*this);
    MotionPrior others = prior;
    others.yawRateSigma = others.speedSigma = 0;
    if (prior.yawRateSigma > 0)
        neutral.params.priorYawRate = std::max(params.priorYawRate, std::abs(prior.yawRate));
    if (prior.speedSigma > 0)
    {
        neutral.params.reverseProbability = 1;
        neutral.params.priorSpeed = std::max(std::abs(prior.speed), prior.speedSigma);
    }
    const AckermannMotion seen = neutral.run(segments, noArray(), others);
    if (seen.status != MOTION_OK)
        return motion;
    const Matx44d covariance = seen.metricCovariance(camera);
    if (prior.yawRateSigma > 0 && covariance(0, 0) > 0 && seen.yawRate(camera, motion.seenYawRate))
        motion.seenYawRateSigma = std::sqrt(covariance(0, 0));
    if (prior.speedSigma > 0 && covariance(1, 1) > 0 && seen.speed(camera, motion.seenSpeed))
        motion.seenSpeedSigma = std::sqrt(covariance(1, 1));
    compareWithGiven(prior, showsOtherDirection(seen, prior), motion);
    return motion;
}

AckermannMotion AckermannEstimatorImpl::run(const Mat& segments, OutputArray labels_, const MotionPrior& prior) const
{
    prior.check();
    AckermannMotion motion;
    Mat labels(segments.rows, 1, CV_8U, Scalar(SEGMENT_REJECTED));
    if (!camera.isRowShutter())
        motion.status = MOTION_NOT_OBSERVABLE;
    else
    {
        const MotionLimits limits(camera, params);
        const DrivingPrior driving(prior, camera, params, limits);
        RefinementProblem problem = makeProblem(limits);
        problem.prior = &driving;
        problem.roadRatio = driving.roadRatio();
        selectCandidates(segments, camera, params, problem.verticals, problem.others);
        problem.arrange();
        for (size_t i = 0; i < problem.verticals.size(); i++)
            labels.at<uchar>(problem.verticals[i].index) = SEGMENT_OUTLIER;
        motion.candidates = (int)problem.verticals.size();
        Posterior found;
        motion.status = motion.candidates < params.minCandidates ? MOTION_TOO_FEW_SEGMENTS
                                                                 : findMotion(problem, found, motion, labels);
        if (motion.status == MOTION_OK)
            addFocalUncertainty(problem, camera, params, prior, segments, found);
        if (motion.status == MOTION_OK && !(found.expectedResidual < found.expectedRaw))
            motion.status = MOTION_NOT_SIGNIFICANT;
        motion.expectedRaw = found.expectedRaw;
        motion.expectedResidual = found.expectedResidual;
        if (motion.status == MOTION_OK)
        {
            motion.probabilityWorse = found.probabilityWorse;
            report(problem, prior, found, motion);
        }
        else
            motion.expectedResidual = motion.expectedRaw;
    }
    if (labels_.needed())
        labels.copyTo(labels_);
    return motion;
}

// Returns the status.
int AckermannEstimatorImpl::findMotion(RefinementProblem& problem, Posterior& found, AckermannMotion& motion,
                                       Mat& labels) const
{
    if (!explorePosterior(problem, params, DisplacementField(camera, problem.ends()), found))
        return MOTION_NO_CONSENSUS;
    const Agreement agreement = {problem.focal, params.threshold, problem.lean};
    labelInliers(problem.verticals, found.model, problem.heading, agreement, motion, labels);
    return found.hypothesis.motion != MODEL_NONE ? MOTION_OK : MOTION_NOT_SIGNIFICANT;
}

void AckermannEstimatorImpl::report(const RefinementProblem& problem, const MotionPrior& prior, const Posterior& found,
                                    AckermannMotion& motion) const
{
    const Model& m = found.model;
    motion.model = found.hypothesis.motion;
    setModel(m, found.G, found.covariance, motion);

    // Measurements give a length; a prior doesn't.
    const double speed = std::hypot(motion.wallSlope, motion.wallOffset);
    if (!(speed > 0) || setGivenScale(camera, params, prior, motion))
        return;
    if (params.scaleFromRoad && camera.height > 0)
    {
        const double ratio = findRoadRatio(problem, m, params.threshold);
        if (ratio > 0)
        {
            motion.scale = SCALE_ROAD;
            motion.wallDistance = ratio * camera.height;
            motion.roadSlope = motion.direction * speed * ratio;
        }
    }
}

} // namespace

Ptr<AckermannEstimator> AckermannEstimator::create(const RollingShutterCamera& camera,
                                                   const AckermannEstimator::Params& params)
{
    return makePtr<AckermannEstimatorImpl>(camera, params);
}

Ptr<AckermannEstimator> AckermannEstimator::load(const String& filename, const String& objname)
{
    return AlgorithmStorage<AckermannEstimator>::load(filename, objname);
}

}} // namespace cv::rsackermann
