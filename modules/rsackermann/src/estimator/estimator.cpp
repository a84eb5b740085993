// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../segments.hpp"
#include "../storage.hpp"
#include "account.hpp"
#include "focal_uncertainty.hpp"
#include "posterior.hpp"
#include "road_contact.hpp"
#include "selection.hpp"
#include "significance.hpp"

namespace cv { namespace rsackermann {

// First guesses for the segments of a detector; selectMotion() measures the noise of the image.
static const double FIRST_SIGMA = 0.25, FIRST_OTHERS_SIGMA = 1; // pixels
static const double FIRST_LOSS_SCALE = 3;                       // sigmas

namespace {

class AckermannEstimatorImpl CV_FINAL : public AckermannEstimator
{
public:
    AckermannEstimatorImpl(const RollingShutterCamera& camera_, const Params& params_)
    {
        setCamera(camera_);
        setParams(params_);
    }

    void setCamera(const RollingShutterCamera& camera_) CV_OVERRIDE
    {
        camera_.check();
        camera = camera_;
    }

    RollingShutterCamera getCamera() const CV_OVERRIDE { return camera; }

    void setParams(const Params& params_) CV_OVERRIDE
    {
        params_.check();
        params = params_;
    }

    Params getParams() const CV_OVERRIDE { return params; }

    AckermannMotion estimate(InputArray segments, OutputArray labels, const MotionPrior& prior) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        return run(segmentRows(segments), labels, prior);
    }

    AckermannMotion estimateFromImage(InputArray image, OutputArray segments, OutputArray labels,
                                      const MotionPrior& prior) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        if (image.size() != camera.imageSize)
            CV_Error(Error::StsBadArg,
                     format("image is %d x %d; the camera's size %d x %d is expected", image.size().width,
                            image.size().height, camera.imageSize.width, camera.imageSize.height));
        Mat found;
        detectSegments(image, found, params.detector, params.minLength);
        if (segments.needed())
            returnSegments(found, segments);
        return run(segmentRows(found), labels, prior);
    }

    void write(FileStorage& fs) const CV_OVERRIDE
    {
        writeFormat(fs);
        AlgorithmStorage<AckermannEstimator>::write(*this, fs);
    }

    void read(const FileNode& fn) CV_OVERRIDE { AlgorithmStorage<AckermannEstimator>::read(fn, *this); }

    String getDefaultName() const CV_OVERRIDE { return "rsackermann_AckermannEstimator"; }

private:
    AckermannMotion run(const Mat& segments, OutputArray labels, const MotionPrior& prior) const;
    RefinementProblem makeProblem(const MotionPrior& prior) const;
    int findMotion(RefinementProblem& problem, const UsualDrive& usual, Posterior& found, AckermannMotion& motion,
                   Mat& labels) const;
    Posterior withExpectation(const RefinementProblem& problem, const UsualDrive& usual, const Fit& fit) const;
    double label(const RefinementProblem& problem, const Posterior& found, AckermannMotion& motion, Mat& labels) const;
    void report(const RefinementProblem& problem, const MotionPrior& prior, const Posterior& found,
                AckermannMotion& motion) const;

    RollingShutterCamera camera;
    Params params;
};

RefinementProblem AckermannEstimatorImpl::makeProblem(const MotionPrior& prior) const
{
    const MotionLimits limits(camera, params);
    RefinementProblem problem(limits);
    problem.prior = PriorTerms(prior, camera, params, limits);
    problem.heading = camera.heading;
    problem.focal = camera.cameraMatrix(0, 0);
    problem.sigma = FIRST_SIGMA;
    problem.directionSigma = FIRST_OTHERS_SIGMA;
    problem.lossScale = FIRST_LOSS_SCALE;
    problem.gravitySigma = params.gravitySigma;
    problem.vehiclePitchSigma = params.vehiclePitchSigma;
    return problem;
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
        RefinementProblem problem = makeProblem(prior);
        const UsualDrive usual(prior, camera, params, problem.limits);
        problem.roadRatio = usual.roadRatio();
        selectCandidates(segments, camera, params, problem.verticals, problem.others);
        problem.arrange();
        for (size_t i = 0; i < problem.verticals.size(); i++)
            labels.at<uchar>(problem.verticals[i].index) = SEGMENT_OUTLIER;
        motion.candidates = (int)problem.verticals.size();
        Posterior found;
        motion.status = motion.candidates < params.minCandidates ? MOTION_TOO_FEW_SEGMENTS
                                                                 : findMotion(problem, usual, found, motion, labels);
        if (motion.status == MOTION_OK)
            addFocalUncertainty(problem, camera, params, prior, segments, found);
        if (motion.status == MOTION_OK && !found.helps())
            motion.status = MOTION_NOT_SIGNIFICANT;
        motion.expectedRaw = found.expectedRaw;
        motion.expectedLeft = found.expectedLeft;
        if (motion.status == MOTION_OK)
            report(problem, prior, found, motion);
        else
            motion.expectedLeft = motion.expectedRaw;
    }
    if (labels_.needed())
        labels.copyTo(labels_);
    return motion;
}

// Returns the status.
int AckermannEstimatorImpl::findMotion(RefinementProblem& problem, const UsualDrive& usual, Posterior& found,
                                       AckermannMotion& motion, Mat& labels) const
{
    if (params.model == MODEL_AUTO && params.gravitySigma > 0)
    {
        problem.usual = &usual;
        problem.prior.usualAlpha = 0;
        if (!explorePosterior(problem, params, DisplacementField(camera), found))
            return MOTION_NO_CONSENSUS;
        label(problem, found, motion, labels);
    }
    else
    {
        found = withExpectation(problem, usual, selectMotion(problem, params));
        const double chance = label(problem, found, motion, labels);
        if (logFalseAlarms(motion.candidates, motion.inliers, found.hypothesis.sampleSize(), chance) > 0)
            return MOTION_NO_CONSENSUS;
    }
    return found.hypothesis.motion != MODEL_NONE ? MOTION_OK : MOTION_NOT_SIGNIFICANT;
}

Posterior AckermannEstimatorImpl::withExpectation(const RefinementProblem& problem, const UsualDrive& usual,
                                                  const Fit& fit) const
{
    const DisplacementField field(camera);
    Posterior found;
    found.model = fit.model;
    found.hypothesis = fit.hypothesis;
    found.covariance = fit.covariance;
    double variance;
    usual.road(fit.model, findRoadContact(problem, fit.model, fit.covariance, params.threshold), found.G, variance);
    DisplacementField::Values displacement;
    DisplacementField::Variances variances;
    field.displacement(found.model, found.G, displacement);
    field.variance(found.model, found.G, variance, found.covariance, variances);
    found.expectedRaw = DisplacementField::meanDistance(displacement, DisplacementField::Values(), variances);
    found.expectedLeft = DisplacementField::meanDistance(displacement, displacement, variances);
    return found;
}

// Returns the mean probability that a candidate with a random slant is an inlier.
double AckermannEstimatorImpl::label(const RefinementProblem& problem, const Posterior& found, AckermannMotion& motion,
                                     Mat& labels) const
{
    const Agreement agreement = {problem.focal, params.threshold, problem.lean};
    return labelInliers(problem.verticals, found.model, problem.heading, agreement, motion, labels);
}

void AckermannEstimatorImpl::report(const RefinementProblem& problem, const MotionPrior& prior, const Posterior& found,
                                    AckermannMotion& motion) const
{
    const Model& m = found.model;
    motion.model = found.hypothesis.motion;
    motion.alpha = m[P_ALPHA];
    motion.wallSlope = m[P_B];
    motion.wallOffset = m[P_D];
    motion.wallRatio = m[P_LAMBDA];
    motion.roadSlope = found.G;
    motion.direction = m.direction < 0 ? -1 : 1;
    motion.rollCorrection = m[P_ROLL];
    motion.pitchCorrection = m[P_PITCH];
    for (int i = P_ALPHA; i <= P_LAMBDA; i++)
        for (int j = P_ALPHA; j <= P_LAMBDA; j++)
            motion.covariance(i, j) = found.covariance(i, j);
    motion.rollYawAmbiguous = isRollYawAmbiguous(found.covariance);

    // Measurements give a length; usual values don't.
    const double speed = std::hypot(motion.wallSlope, motion.wallOffset);
    if (!(speed > 0) || setToldScale(camera, params, prior, motion))
        return;
    if (params.scaleFromRoad && camera.height > 0)
    {
        const double ratio = findRoadContact(problem, m, found.covariance, params.threshold).ratio;
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
