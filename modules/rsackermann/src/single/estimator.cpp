// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/lens.hpp"
#include "../checks.hpp"
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
        return estimateRows(segmentRows(segments), labels, prior);
    }

    AckermannMotion estimateFromImage(InputArray image, OutputArray segments, OutputArray labels,
                                      const MotionPrior& prior) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        checkImage(image, "image", camera.imageSize);
        checkApart(labels, "labels", segments, "segments");
        Mat found;
        detectSegments(image, found, params.detector, params.minLength);
        if (segments.needed())
            returnSegments(found, segments);
        return estimateRows(segmentRows(found), labels, prior);
    }

    String getDefaultName() const CV_OVERRIDE { return "rsackermann_AckermannEstimator"; }

private:
    RefinementProblem makeProblem(const Mat& segments, const MotionLimits& limits) const
    {
        RefinementProblem problem(limits);
        problem.uprightRotation = camera.uprightRotation;
        problem.distortionSigma = camera.distortionSigma;
        problem.heading = camera.heading;
        problem.focal = camera.cameraMatrix(0, 0);
        problem.sigma = END_SIGMA;
        problem.directionSigma = FIRST_OTHERS_SIGMA;
        const TiltSigmas tilts(camera, params);
        problem.gravitySigma = tilts.roll;
        problem.vehiclePitchSigma = tilts.pitch;
        problem.streetDeviation = params.wallDeviationSigma;
        const double middle = (camera.imageSize.height - 1) / 2.;
        const std::vector<Vec3d> borders = bearingsOf(
            camera, camera.uprightRotation, {Point2d(0, middle), Point2d(camera.imageSize.width - 1, middle)});
        problem.leftmost = borders[0][0] / std::max(borders[0][2], IN_FRONT);
        problem.rightmost = borders[1][0] / std::max(borders[1][2], IN_FRONT);
        selectCandidates(segments, camera, params, problem.verticals, problem.others);
        problem.arrange();
        return problem;
    }

    // The estimate is near a given value whatever the image shows: a contradiction shows without the values alone,
    // since one that is wrong would make the other one look so.
    void compareWithSeen(RefinementProblem& problem, const Mat& segments, const MotionPrior& prior,
                         AckermannMotion& motion) const
    {
        // What is seen decides, not how seldom cars reverse, or drive or turn as fast as is given.
        AckermannEstimatorImpl neutral(*this);
        MotionPrior others = prior;
        others.yawRateSigma = others.speedSigma = 0;
        if (prior.yawRateSigma > 0)
            neutral.params.priorYawRate = std::max(params.priorYawRate, std::abs(prior.yawRate));
        if (prior.speedSigma > 0)
        {
            neutral.params.reverseProbability = 0.5;
            neutral.params.priorSpeed = std::max(std::abs(prior.speed), prior.speedSigma);
        }
        AckermannMotion seen;
        Mat labels;
        neutral.findMotion(problem, segments, others, seen, labels);
        if (seen.status != MOTION_OK)
            return;
        const Matx44d covariance = seen.metricCovariance(camera);
        if (prior.yawRateSigma > 0 && covariance(0, 0) > 0 && seen.yawRate(camera, motion.seenYawRate))
            motion.seenYawRateSigma = std::sqrt(covariance(0, 0));
        if (prior.speedSigma > 0 && covariance(1, 1) > 0 && seen.speed(camera, motion.seenSpeed))
            motion.seenSpeedSigma = std::sqrt(covariance(1, 1));
        const bool contradictsWall = motion.contradictsPrior;
        compareWithGiven(prior, showsOtherDirection(seen, prior), motion);
        motion.contradictsPrior |= contradictsWall || seen.contradictsPrior;
    }

    AckermannMotion estimateRows(const Mat& segments, OutputArray labels, const MotionPrior& prior) const
    {
        prior.check();
        return AckermannEstimatorImpl(camera, withLimitsOf(prior, params)).run(segments, labels, prior);
    }

    AckermannMotion run(const Mat& segments, OutputArray labels_, const MotionPrior& prior) const
    {
        if (labels_.needed())
            checkOutput(labels_, "labels", Size(1, segments.rows), CV_8U);
        AckermannMotion motion;
        Mat labels(segments.rows, 1, CV_8U, Scalar(SEGMENT_REJECTED));
        if (!camera.isRowShutter())
            motion.status = MOTION_NOT_OBSERVABLE;
        else
        {
            RefinementProblem problem = makeProblem(segments, MotionLimits(camera, params));
            for (size_t i = 0; i < problem.verticals.size(); i++)
                labels.at<uchar>(problem.verticals[i].index) = SEGMENT_OUTLIER;
            motion.candidates = (int)problem.verticals.size();
            if (motion.candidates < params.minCandidates)
                motion.status = MOTION_TOO_FEW_SEGMENTS;
            else
                findMotion(problem, segments, prior, motion, labels);
            const bool isGiven = prior.yawRateSigma > 0 || prior.speedSigma > 0;
            if (isGiven && camera.lineDelay > 0 &&
                (motion.status == MOTION_OK || motion.status == MOTION_NOT_SIGNIFICANT))
                compareWithSeen(problem, segments, prior, motion);
        }
        if (labels_.needed())
            labels.copyTo(labels_);
        return motion;
    }

    // Sets the motion with its status. Without labels they aren't needed.
    void findMotion(RefinementProblem& problem, const Mat& segments, const MotionPrior& prior, AckermannMotion& motion,
                    Mat& labels) const
    {
        const DrivingPrior driving(prior, camera, params);
        problem.prior = &driving;
        problem.roadRatio = driving.roadRatio();
        Posterior found;
        if (explorePosterior(problem, params, DisplacementField(camera, problem.ends()), found))
        {
            const Agreement agreement = {problem.focal, params.threshold, problem.lean};
            if (!labels.empty())
                labelInliers(problem.verticals, found.model, problem.heading, agreement, motion, labels);
            decide(problem, segments, prior, found, motion);
        }
        else
            motion.status = MOTION_NO_CONSENSUS;
        problem.prior = 0;
    }

    void decide(const RefinementProblem& problem, const Mat& segments, const MotionPrior& prior, Posterior& found,
                AckermannMotion& motion) const
    {
        const bool moves = found.hypothesis.motion != MODEL_NONE;
        if (moves)
            addFocalUncertainty(problem, camera, params, prior, segments, found);
        motion.expectedRaw = motion.expectedResidual = found.expectedRaw;
        motion.status = moves && found.expectedResidual < found.expectedRaw ? MOTION_OK : MOTION_NOT_SIGNIFICANT;
        if (motion.status != MOTION_OK)
            return;
        motion.expectedResidual = found.expectedResidual;
        motion.probabilityWorse = found.probabilityWorse;
        motion.contradictsPrior = found.contradictsWall;
        report(prior, found, motion);
    }

    void report(const MotionPrior& prior, const Posterior& found, AckermannMotion& motion) const
    {
        const Model& m = found.model;
        motion.model = found.hypothesis.motion;
        setModel(m, found.G, found.covariance, motion);
        keepSeenWalls(camera, motion);

        // Measurements give a length; a prior doesn't, and a speed of 0 +- 30 km/h doesn't, either.
        const double speed = std::hypot(motion.wallSlope, motion.wallOffset);
        Params given = params;
        if (found.contradictsWall && camera.height > 0)
            given.wallDistance = 0;
        const bool isGiven = given.wallDistance > 0 || prior.speed != 0;
        if (!(speed > 0) || (isGiven && setGivenScale(camera, given, prior, motion)))
            return;
        if (found.roadSigma > 0 && camera.height > 0)
        {
            motion.scale = SCALE_ROAD;
            motion.wallDistance = std::abs(motion.roadSlope) / speed * camera.height;
            setSpeedSigma(camera, std::hypot(found.roadSigma, HEIGHT_SIGMA), motion);
        }
    }
};

} // namespace

Ptr<AckermannEstimator> AckermannEstimator::create(const RollingShutterCamera& camera,
                                                   const AckermannEstimator::Params& params)
{
    return makePtr<AckermannEstimatorImpl>(camera, params);
}

Ptr<AckermannEstimator> AckermannEstimator::load(const String& filename, const String& objname)
{
    return StoredAlgorithm<AckermannEstimator>::load(filename, objname);
}

}} // namespace cv::rsackermann
