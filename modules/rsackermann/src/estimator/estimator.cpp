// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../scene.hpp"
#include "../segments.hpp"
#include "road_contact.hpp"
#include "selection.hpp"
#include "significance.hpp"
#include "vertical_residual.hpp"

namespace cv {
namespace rsackermann {

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

    AckermannMotion estimateFromImage(InputArray image, OutputArray segments, OutputArray labels, const MotionPrior& prior) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        if (image.size() != camera.imageSize)
            CV_Error(Error::StsBadArg, format("image is %d x %d; the camera's size %d x %d is expected", image.size().width,
                                              image.size().height, camera.imageSize.width, camera.imageSize.height));
        Mat found;
        detectSegments(image, found, params.detector, params.minLength);
        if (segments.needed())
            found.copyTo(segments);
        return run(segmentRows(found), labels, prior);
    }

    void write(FileStorage& fs) const CV_OVERRIDE
    {
        writeFormat(fs);
        params.write(fs);
    }

    void read(const FileNode& fn) CV_OVERRIDE
    {
        Params p = params;
        p.read(fn);
        setParams(p);
    }

    String getDefaultName() const CV_OVERRIDE { return "rsackermann.AckermannEstimator"; }

private:
    AckermannMotion run(const Mat& segments, OutputArray labels, const MotionPrior& prior) const;
    RefinementProblem makeProblem(const MotionPrior& prior) const;
    void report(const RefinementProblem& problem, const Fit& fit, AckermannMotion& motion, Mat& labels) const;

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
    // First guesses for the segments of a detector; selectMotion() measures the noise of the image.
    problem.sigma = 0.25;
    problem.directionSigma = 1;
    problem.lossScale = 3;
    const bool knowsRoad = params.wallDistance > 0 && camera.height > 0;
    problem.roadRatio = knowsRoad ? params.wallDistance / camera.height : params.roadRatio;
    problem.gravitySigma = params.gravitySigma;
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
        selectCandidates(segments, camera, params, problem.verticals, problem.others);
        problem.arrange();
        for (size_t i = 0; i < problem.verticals.size(); i++)
            labels.at<uchar>(problem.verticals[i].index) = SEGMENT_OUTLIER;
        motion.candidates = (int)problem.verticals.size();
        if (motion.candidates < params.minCandidates)
            motion.status = MOTION_TOO_FEW_SEGMENTS;
        else
            report(problem, selectMotion(problem, params), motion, labels);
    }
    if (labels_.needed())
        labels.copyTo(labels_);
    return motion;
}

void AckermannEstimatorImpl::report(const RefinementProblem& problem, const Fit& fit, AckermannMotion& motion, Mat& labels) const
{
    double sum = 0, chance = 0;
    for (size_t i = 0; i < problem.verticals.size(); i++)
    {
        const Candidate& c = problem.verticals[i];
        chance += std::min(1., params.threshold / (problem.focal * c.gate)) / motion.candidates;
        int wall;
        const double r = problem.focal * verticalResidual(c, fit.model, problem.heading, wall, 0);
        if (!(std::abs(r) < params.threshold))
            continue;
        labels.at<uchar>(c.index) = wall == Scene::RIGHT_WALL ? SEGMENT_RIGHT_WALL : SEGMENT_LEFT_WALL;
        motion.inliers++;
        sum += r * r;
    }
    motion.rms = motion.inliers > 0 ? std::sqrt(sum / motion.inliers) : 0;
    if (logFalseAlarms(motion.candidates, motion.inliers, fit.structure.sampleSize(), chance) > 0)
    {
        motion.status = MOTION_NO_CONSENSUS;
        return;
    }
    if (fit.structure.motion == MODEL_NONE)
        return;
    motion.status = MOTION_OK;
    motion.model = fit.structure.motion;
    motion.alpha = fit.model[P_ALPHA];
    motion.B = fit.model[P_B];
    motion.D = fit.model[P_D];
    motion.lambda = fit.model[P_LAMBDA];
    motion.direction = fit.model.direction < 0 ? -1 : 1;
    motion.rollCorrection = fit.model[P_ROLL];
    motion.pitchCorrection = fit.model[P_PITCH];
    motion.wallDistance = fit.structure.translates() ? params.wallDistance : 0;
    double roadRatio = problem.roadRatio;
    bool knowsRoad = params.wallDistance > 0 && camera.height > 0;
    if (params.scaleFromRoad && !knowsRoad && fit.structure.translates() && camera.height > 0)
    {
        const double found = roadRatioFromContacts(problem, fit.model, params.threshold);
        if (found > 0)
        {
            knowsRoad = true;
            roadRatio = found;
            motion.wallDistance = found * camera.height;
        }
    }
    if (knowsRoad || fit.structure.walls == 2)
        motion.G = motion.direction * std::hypot(motion.B, motion.D) * roadRatio;
    for (int i = P_ALPHA; i <= P_LAMBDA; i++)
        for (int j = P_ALPHA; j <= P_LAMBDA; j++)
            motion.covariance(i, j) = fit.covariance(i, j);
    const double variances = fit.covariance(P_ALPHA, P_ALPHA) * fit.covariance(P_ROLL, P_ROLL);
    motion.rollYawAmbiguous = variances > 0 && std::abs(fit.covariance(P_ALPHA, P_ROLL)) > 0.9 * std::sqrt(variances);
}

} // namespace

Ptr<AckermannEstimator> AckermannEstimator::create(const RollingShutterCamera& camera, const AckermannEstimator::Params& params)
{
    return makePtr<AckermannEstimatorImpl>(camera, params);
}

}} // namespace cv::rsackermann
