// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "precomp.hpp"
#include "opencv2/rsackermann/corrector.hpp"
#include "opencv2/core/ocl.hpp"
#include "opencv2/imgproc.hpp"
#include "camera/lens.hpp"
#include "checks.hpp"
#include "features/segment_finder.hpp"
#include "motion/metric_way.hpp"
#include "sequence/sequence_estimator.hpp"
#include "single/relative_depth.hpp"
#include "storage.hpp"
#include "warp/maps/maps.hpp"
#include <atomic>

namespace cv { namespace rsackermann {

RollingShutterCorrector::Params::Params()
    : interpolation(INTER_LINEAR), sequence(false), trackPoints(true), frameInterval(1. / 30)
{
    const GyroSigmas gyro;
    gyroDelaySigma = gyro.delay;
    gyroAxesSigma = gyro.axes;
    gyroBiasSigma = gyro.bias;
    gyroScaleSigma = gyro.scale;
}

void RollingShutterCorrector::Params::setEstimatorParams(const AckermannEstimator::Params& params)
{
    estimator = params;
}

AckermannEstimator::Params RollingShutterCorrector::Params::getEstimatorParams() const
{
    return estimator;
}

void RollingShutterCorrector::Params::setWarpParams(const WarpMapGenerator::Params& params)
{
    warp = params;
}

WarpMapGenerator::Params RollingShutterCorrector::Params::getWarpParams() const
{
    return warp;
}

void RollingShutterCorrector::Params::write(FileStorage& fs) const
{
    fs.startWriteStruct("estimator", FileNode::MAP);
    estimator.write(fs);
    fs.endWriteStruct();
    fs.startWriteStruct("warp", FileNode::MAP);
    warp.write(fs);
    fs.endWriteStruct();
    fs << "interpolation" << interpolation << "sequence" << sequence << "track_points" << trackPoints
       << "frame_interval" << frameInterval << "gyro_delay_sigma" << gyroDelaySigma << "gyro_axes_sigma"
       << gyroAxesSigma << "gyro_bias_sigma" << gyroBiasSigma << "gyro_scale_sigma" << gyroScaleSigma;
}

void RollingShutterCorrector::Params::read(const FileNode& fn)
{
    estimator.read(fn["estimator"]);
    warp.read(fn["warp"]);
    readFields(fn, "interpolation", interpolation, "sequence", sequence, "track_points", trackPoints);
    readFields(fn, "frame_interval", frameInterval, "gyro_delay_sigma", gyroDelaySigma);
    readFields(fn, "gyro_axes_sigma", gyroAxesSigma, "gyro_bias_sigma", gyroBiasSigma);
    readFields(fn, "gyro_scale_sigma", gyroScaleSigma);
}

void RollingShutterCorrector::Params::check() const
{
    estimator.check();
    warp.check();
    REJECT_IF(interpolation != INTER_NEAREST && interpolation != INTER_LINEAR && interpolation != INTER_CUBIC &&
                  interpolation != INTER_LANCZOS4,
              "interpolation is %d; INTER_NEAREST (%d), INTER_LINEAR (%d), INTER_CUBIC (%d) or INTER_LANCZOS4 (%d) is "
              "expected",
              interpolation, INTER_NEAREST, INTER_LINEAR, INTER_CUBIC, INTER_LANCZOS4);
    REJECT_IF(!(frameInterval > 0 && frameInterval <= 3600),
              "params.frameInterval is %g; more than 0 and at most 3600 seconds are expected", frameInterval);
    checkPositive(gyroDelaySigma, "params.gyroDelaySigma");
    checkPositive(gyroAxesSigma, "params.gyroAxesSigma");
    checkPositive(gyroBiasSigma, "params.gyroBiasSigma");
    checkPositive(gyroScaleSigma, "params.gyroScaleSigma");
    REJECT_IF(
        sequence && trackPoints && estimator.model != MODEL_AUTO,
        "params.estimator.model is %d; MODEL_AUTO (%d) is expected if points are tracked from frame to frame (sequence "
        "and trackPoints)",
        estimator.model, MODEL_AUTO);
}

// Whether a camera at rest already gives the global-shutter image.
static bool isIdentity(const RollingShutterCamera& camera, const WarpMapGenerator::Params& warp)
{
    return Lens<double>(camera).kind == Lens<double>::NONE &&
           (warp.newCameraMatrix == Matx33d::zeros() || warp.newCameraMatrix == camera.cameraMatrix) &&
           (warp.newSize == Size() || warp.newSize == camera.imageSize);
}

static bool isSameButForGravity(const RollingShutterCamera& a, const RollingShutterCamera& b)
{
    return a.imageSize == b.imageSize && a.cameraMatrix == b.cameraMatrix && a.distCoeffs == b.distCoeffs &&
           a.lensModel == b.lensModel && a.scanDirection == b.scanDirection && a.lineDelay == b.lineDelay &&
           a.referenceRow == b.referenceRow && a.heading == b.heading && a.height == b.height;
}

// Of a depth in metres; 0, NaN and infinity are unknown.
static bool isKnownSomewhere(const Mat& depth)
{
    return countNonZero((depth > 0) & (depth <= FLT_MAX)) > 0;
}

// Of both, whichever was set last: checked when they are used.
static void checkTiming(const RollingShutterCamera& camera, const RollingShutterCorrector::Params& params)
{
    REJECT_IF(params.sequence && !(camera.lineDelay > 0),
              "camera.lineDelay is %g s; a positive one is expected if images are a sequence (params.sequence)",
              camera.lineDelay);
}

namespace {

// Milliseconds between calls.
class Stopwatch
{
public:
    Stopwatch() : last(getTickCount()) {}

    double lap()
    {
        const int64 now = getTickCount();
        const double ms = (now - last) * 1000. / getTickFrequency();
        last = now;
        return ms;
    }

private:
    int64 last;
};

class RollingShutterCorrectorImpl CV_FINAL : public StoredAlgorithm<RollingShutterCorrector>
{
public:
    RollingShutterCorrectorImpl(const RollingShutterCamera& camera, const Params& params_)
        : estimator(AckermannEstimator::create(camera, params_.estimator)),
          generator(WarpMapGenerator::create(camera, params_.warp)), sequence(camera, params_.estimator, estimator),
          time(0), hasTime(false), timestamp(std::numeric_limits<double>::quiet_NaN()), onDevice(false),
          isTracked_(false), isGyroUsed_(false), isDepthUsed_(false)
    {
        params_.check();
        checkTiming(camera, params_);
        params = params_;
        setGyroSigmas();
    }

    void setCamera(const RollingShutterCamera& camera) CV_OVERRIDE
    {
        const bool isSame = isSameButForGravity(camera, generator->getCamera());
        estimator->setCamera(camera);
        generator->setCamera(camera);
        sequence.set(camera, params.estimator);
        setGyroSigmas();
        if (!isSame)
            reset();
    }

    RollingShutterCamera getCamera() const CV_OVERRIDE { return generator->getCamera(); }

    void setParams(const Params& params_) CV_OVERRIDE
    {
        params_.check(); // before any of them is set
        estimator->setParams(params_.estimator);
        generator->setParams(params_.warp);
        params = params_;
        sequence.set(generator->getCamera(), params.estimator);
        setGyroSigmas();
    }

    Params getParams() const CV_OVERRIDE { return params; }

    void setPrior(const MotionPrior& prior_) CV_OVERRIDE
    {
        prior_.check();
        prior = prior_;
    }

    MotionPrior getPrior() const CV_OVERRIDE { return prior; }

    void setTimestamp(double seconds) CV_OVERRIDE
    {
        checkTime(seconds);
        timestamp = seconds;
    }

    void addGyro(InputArray times, InputArray rates) CV_OVERRIDE
    {
        const Mat seconds = matrixOf(times, "times");
        sequence.gyro.samples.add(seconds, matrixOf(rates, "rates"));
        const double memory = 60;        // seconds, more than delays and the turns of points need
        if (hasTime && !seconds.empty()) // the samples may be of another clock
            sequence.gyro.samples.forgetBefore(std::min(time, seconds.at<double>(0)) - memory);
    }

    bool getGyroAlignment(double& delay, Vec3d& axes, Vec3d& bias) const CV_OVERRIDE
    {
        const GyroAlignment& found = sequence.gyro.alignment();
        delay = found.delay;
        axes = found.turn;
        bias = found.bias;
        return !sequence.gyro.isWrong();
    }

    bool isGyroUsed() const CV_OVERRIDE { return isGyroUsed_; }

    void clearGyro() CV_OVERRIDE
    {
        sequence.gyro.samples.clear();
        sequence.gyro.reset();
    }

    void skipFrame() CV_OVERRIDE { passTo(timeOfFrame()); }

    void setNextFrame(InputArray image, double seconds) CV_OVERRIDE
    {
        checkImage(image, "image", generator->getCamera().imageSize);
        checkTime(seconds);
        finder.prepare(image);
        finder.reduced().copyTo(next.gray);
        next.scale = finder.reduction();
        next.seconds = seconds;
        finder.release();
    }

    void reset() CV_OVERRIDE
    {
        sequence.reset();
        passTo(0);
        hasTime = false;
    }

    void clear() CV_OVERRIDE
    {
        clearGyro();
        reset();
        prior = MotionPrior();
    }

    AckermannMotion correct(InputArray src, OutputArray dst, OutputArray mask, const DepthMap& depth) CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        checkTiming(generator->getCamera(), params);
        checkImage(src, "src", generator->getCamera().imageSize);
        checkOutputs(src, dst, mask);
        checkDepth(depth, generator->getCamera(), params.warp);
        Stopwatch watch;
        finder.find(src, params.estimator.detector, params.estimator.minLength, segments);
        timings = Vec4d(watch.lap(), 0, 0, 0);
        return estimateAndWarp(src, dst, mask, depth);
    }

    AckermannMotion correctWithSegments(InputArray src, InputArray segments_, OutputArray dst, OutputArray mask,
                                        const DepthMap& depth) CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        const bool isLookedAt = params.sequence && params.trackPoints;
        checkTiming(generator->getCamera(), params);
        checkSource(src);
        if (isLookedAt)
            checkImage(src, "src");
        checkOutputs(src, dst, mask);
        checkDepth(depth, generator->getCamera(), params.warp);
        segments = segmentRows(segments_);
        timings = Vec4d();
        if (isLookedAt)
            finder.prepare(src);
        return estimateAndWarp(src, dst, mask, depth);
    }

    void correctWithMotion(InputArray src, const AckermannMotion& motion, OutputArray dst, OutputArray mask,
                           const DepthMap& depth) CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        checkSource(src);
        checkMotion(motion);
        checkOutputs(src, dst, mask);
        checkDepth(depth, generator->getCamera(), params.warp);
        segments.release();
        labels.release();
        isTracked_ = isGyroUsed_ = false;
        timings = Vec4d();
        warpWith(motion, src, dst, mask, depth);
    }

    void getSegments(OutputArray segments_, OutputArray labels_) const CV_OVERRIDE
    {
        checkApart(labels_, "labels", segments_, "segments");
        if (labels_.needed())
            checkOutput(labels_, "labels", labels.size(), CV_8U);
        if (segments_.needed())
            returnSegments(segments, segments_);
        if (labels_.needed())
            labels.copyTo(labels_);
    }

    void getMaps(OutputArray map1_, OutputArray map2_) const CV_OVERRIDE
    {
        checkApart(map2_, "map2", map1_, "map1");
        const Size size = copiedSize != Size() ? copiedSize : onDevice ? deviceMap1.size() : map1.size();
        checkOutput(map1_, "map1", size, CV_32FC1);
        checkOutput(map2_, "map2", size, CV_32FC1);
        if (copiedSize != Size())
            identityMaps(map1_, map2_);
        else if (onDevice)
        {
            deviceMap1.copyTo(map1_);
            deviceMap2.copyTo(map2_);
        }
        else
        {
            map1.copyTo(map1_);
            map2.copyTo(map2_);
        }
    }

    bool isTracked() const CV_OVERRIDE { return isTracked_; }

    bool isDepthUsed() const CV_OVERRIDE { return isDepthUsed_; }

    DepthMap getUsedDepth() const CV_OVERRIDE { return usedDepth; }

    Vec4d getTimings() const CV_OVERRIDE { return timings; }

    String getDefaultName() const CV_OVERRIDE { return "rsackermann_RollingShutterCorrector"; }

private:
    void setGyroSigmas()
    {
        GyroSigmas sigmas;
        sigmas.delay = params.gyroDelaySigma;
        sigmas.axes = params.gyroAxesSigma;
        sigmas.bias = params.gyroBiasSigma;
        const RollingShutterCamera camera = generator->getCamera();
        sigmas.scale = std::hypot(params.gyroScaleSigma, camera.focalSigma / camera.cameraMatrix(0, 0));
        sequence.gyro.setSigmas(sigmas);
    }

    // Of an image in which nothing is looked for.
    void checkSource(InputArray src) const
    {
        checkRemapped(src, "src", generator->getCamera().imageSize, params.interpolation);
        const bool isWide = params.interpolation == INTER_CUBIC || params.interpolation == INTER_LANCZOS4;
        // Refused by cv::remap, whether or not this image needs it.
        REJECT_IF(isWide && src.channels() > 4,
                  "src has %d channels; up to 4 are expected if params.interpolation is INTER_CUBIC (%d) or "
                  "INTER_LANCZOS4 (%d)",
                  src.channels(), INTER_CUBIC, INTER_LANCZOS4);
    }

    // The mask is written before the image is read.
    void checkOutputs(InputArray src, OutputArray dst, OutputArray mask) const
    {
        const Size size = GlobalCamera(generator->getCamera(), params.warp).size;
        const int longest = std::max(std::max(src.cols(), src.rows()), std::max(size.width, size.height));
        // Refused by cv::remap, whether or not this image needs it.
        REJECT_IF(longest >= SHRT_MAX, "src or dst has a side of %d pixels; up to %d are expected", longest,
                  SHRT_MAX - 1);
        checkOutput(dst, "dst", size, src.type());
        if (mask.needed())
            checkOutput(mask, "mask", size, CV_8UC1);
        checkApart(mask, "mask", src, "src");
        checkApart(mask, "mask", dst, "dst");
    }

    // In seconds beyond which there is no room for an interval between frames.
    static void checkTime(double seconds)
    {
        if (std::isfinite(seconds))
            checkRange(seconds, -1e12, 1e12, "seconds");
    }

    double timeOfFrame() const { return std::isfinite(timestamp) ? timestamp : time + params.frameInterval; }

    // A frame of that time is over: what was set for it and of the one after it no longer holds.
    void passTo(double seconds)
    {
        time = seconds;
        hasTime = true;
        timestamp = std::numeric_limits<double>::quiet_NaN();
        next = GrayFrame();
    }

    // The motion of a frame that follows from the one before.
    AckermannMotion estimateFrame(double seconds)
    {
        // A clock that was set back says nothing about the interval. Times that are sums are rounded.
        const double shortest = 1e-4;
        if (seconds - time < shortest)
            sequence.reset();
        if (!std::isfinite(next.seconds))
            next.seconds = seconds + params.frameInterval;
        if (next.seconds - seconds < shortest)
            next = GrayFrame();
        const GrayFrame frame(params.trackPoints ? finder.reduced() : Mat(), finder.reduction(), seconds);
        return sequence.estimate(frame, next, segmentRows(segments), prior, labels);
    }

    AckermannMotion estimateAndWarp(InputArray src, OutputArray dst, OutputArray mask, const DepthMap& depth)
    {
        Stopwatch watch;
        const double seconds = timeOfFrame();
        AckermannMotion motion;
        if (params.sequence)
            motion = estimateFrame(seconds);
        else
            motion = sequence.estimateSingle(timestamp, segments, prior, labels); // a gyro needs a time that is known
        isTracked_ = params.sequence && sequence.isSeen();
        isGyroUsed_ = motion.status == MOTION_OK && sequence.measures(params.sequence ? seconds : timestamp);
        finder.release();
        DepthMap aligned = depth;
        if (!align(motion, aligned))
            aligned = DepthMap();
        timings[1] = watch.lap();
        warpWith(motion, src, dst, mask, aligned);
        passTo(seconds); // last: skipFrame() does it if something has thrown
        return motion;
    }

    // False if the depth isn't used.
    bool align(AckermannMotion& motion, DepthMap& depth) const
    {
        if (depth.empty() || motion.status == MOTION_NOT_OBSERVABLE ||
            (depth.kind == DEPTH_METRIC && !isKnownSomewhere(depth.values)) ||
            isInAnotherUnit(generator->getCamera(), params.warp, motion, depth))
            return false;
        if (depth.camera == DEPTH_RAW)
            return sequence.alignDepth(segmentRows(segments), motion, depth);
        if (depth.kind != DEPTH_METRIC || motion.status != MOTION_OK)
            return false;
        DepthMap raw = seenByRaw(motion, depth);
        if (!sequence.alignDepth(segmentRows(segments), motion, raw))
            return false;
        depth.scale = raw.scale;
        return true;
    }

    // A depth of the global-shutter camera as the raw image is judged by it: where the planes have its pixels.
    DepthMap seenByRaw(const AckermannMotion& motion, const DepthMap& depth) const
    {
        DepthMap raw = depth;
        raw.camera = DEPTH_RAW;
        Mat columns, rows;
        generator->initDistortMap(motion, columns, rows, CV_32FC1);
        raw.values.release();
        remap(depth.values, raw.values, columns, rows, INTER_NEAREST, BORDER_CONSTANT);
        return raw;
    }

    void warpWith(const AckermannMotion& motion, InputArray src, OutputArray dst, OutputArray mask,
                  const DepthMap& given)
    {
        if (src.isMat() && dst.isMat() && src.getMat().data != dst.getMat().data && overlap(src.getMat(), dst.getMat()))
        {
            warpWith(motion, src.getMat().clone(), dst, mask, given);
            return;
        }
        Stopwatch watch;
        isDepthUsed_ = !given.empty() && motion.status == MOTION_OK &&
                       (given.kind == DEPTH_RELATIVE ||
                        (isMetric(generator->getCamera(), motion) && isKnownSomewhere(given.values)));
        usedDepth = isDepthUsed_ ? given : DepthMap();
        const DepthMap& depth = usedDepth;
        const bool copied = motion.status != MOTION_OK && isIdentity(generator->getCamera(), params.warp);
        copiedSize = copied ? src.size() : Size();
        onDevice = !copied && src.isUMat() && ocl::useOpenCL();
        if (copied)
        {
            src.copyTo(dst);
            if (mask.needed())
            {
                mask.create(src.size(), CV_8UC1);
                mask.setTo(255);
            }
        }
        else if (onDevice)
            warp(motion, src, dst, mask, depth, deviceMap1, deviceMap2, watch);
        else if (depth.empty() && src.isMat() && dst.isMat())
            warpTiles(motion, src, dst, mask, watch);
        else
            warp(motion, src, dst, mask, depth, map1, map2, watch);
        timings[3] += watch.lap();
    }

    // Tiles are remapped by the threads that have made their maps, while they are in the cache. Each of both steps has
    // its share of the time.
    void warpTiles(const AckermannMotion& motion, InputArray src, OutputArray dst, OutputArray mask, Stopwatch& watch)
    {
        const RollingShutterCamera camera = generator->getCamera();
        const Size size = GlobalCamera(camera, params.warp).size;
        Mat image = src.getMat();
        dst.create(size, image.type());
        const Mat warped = dst.getMat();
        if (warped.data == image.data)
            image = image.clone();
        MapWriter writer(size, camera.imageSize, CV_32FC1, map1, map2, mask);
        std::atomic<int64> mapTicks(0), remapTicks(0);
        writer.whenWritten = [&](const Rect& tile, int64 start) {
            const int64 middle = getTickCount();
            remap(image, warped(tile), map1(tile), map2(tile), params.interpolation);
            mapTicks += middle - start;
            remapTicks += getTickCount() - middle;
        };
        writeMap(WARP_RECTIFY, camera, params.warp, motion, writer);
        const double ms = watch.lap();
        timings[2] = ms * mapTicks / std::max(mapTicks + remapTicks, int64(1));
        timings[3] = ms - timings[2];
    }

    void warp(const AckermannMotion& motion, InputArray src, OutputArray dst, OutputArray mask, const DepthMap& depth,
              InputOutputArray columns, InputOutputArray rows, Stopwatch& watch)
    {
        generator->initRectifyMap(motion, columns, rows, CV_32FC1, mask, depth);
        timings[2] = watch.lap();
        // On a device remap() would read what it has already written.
        if (src.isUMat() && dst.isUMat() && src.getUMat().u == dst.getUMat().u)
            remap(src.getUMat().clone(), dst, columns, rows, params.interpolation);
        else
            remap(src, dst, columns, rows, params.interpolation);
    }

    void identityMaps(OutputArray map1_, OutputArray map2_) const
    {
        Mat row(1, copiedSize.width, CV_32F), column(copiedSize.height, 1, CV_32F);
        for (int x = 0; x < copiedSize.width; x++)
            row.at<float>(x) = float(x);
        for (int y = 0; y < copiedSize.height; y++)
            column.at<float>(y) = float(y);
        repeat(row, copiedSize.height, 1, map1_);
        repeat(column, 1, copiedSize.width, map2_);
    }

    Params params;
    Ptr<AckermannEstimator> estimator;
    Ptr<WarpMapGenerator> generator;
    SegmentFinder finder;
    MotionPrior prior;
    SequenceEstimator sequence;
    GrayFrame next;   // what is known of the image after the next one
    double time;      // of the last frame
    bool hasTime;     // whether there was one
    double timestamp; // of the next one; not finite: not given

    // of the last image
    Mat segments, labels;
    Mat map1, map2;
    UMat deviceMap1, deviceMap2;
    bool onDevice; // which of the two pairs of maps it was
    bool isTracked_;
    bool isGyroUsed_;
    bool isDepthUsed_;
    DepthMap usedDepth;
    Size copiedSize; // if the image was copied: the maps are the identity and haven't been made
    Vec4d timings;
};

} // namespace

Ptr<RollingShutterCorrector> RollingShutterCorrector::create(const RollingShutterCamera& camera, const Params& params)
{
    CV_INSTRUMENT_REGION();
    return makePtr<RollingShutterCorrectorImpl>(camera, params);
}

Ptr<RollingShutterCorrector> RollingShutterCorrector::load(const String& filename, const String& objname)
{
    return StoredAlgorithm<RollingShutterCorrector>::load(filename, objname);
}

}} // namespace cv::rsackermann
