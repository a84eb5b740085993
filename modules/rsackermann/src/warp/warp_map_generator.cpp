// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../checks.hpp"
#include "../storage.hpp"
#include "maps/maps.hpp"
#include "maps/remap_limits.hpp"
#include "points.hpp"

namespace cv { namespace rsackermann {

WarpMapGenerator::Params::Params() : newCameraMatrix(Matx33d::zeros()), maxIterations(10), tolerance(1e-3) {}

void WarpMapGenerator::Params::write(FileStorage& fs) const
{
    fs << "new_camera_matrix" << newCameraMatrix;
    fs << "new_width" << newSize.width << "new_height" << newSize.height;
    fs << "max_iterations" << maxIterations << "tolerance" << tolerance;
}

void WarpMapGenerator::Params::read(const FileNode& fn)
{
    readMatrix(fn, "new_camera_matrix", newCameraMatrix);
    readFields(fn, "new_width", newSize.width, "new_height", newSize.height, "max_iterations", maxIterations);
    readFields(fn, "tolerance", tolerance);
}

static void checkNewCameraMatrix(const Matx33d& K)
{
    if (K == Matx33d::zeros())
        return;
    REJECT_IF(
        !cv::checkRange(K) || !(K(0, 0) > 0) || !(K(1, 1) > 0) || K(1, 0) != 0 || K(2, 0) != 0 || K(2, 1) != 0 ||
            K(2, 2) != 1,
        "newCameraMatrix is (%g %g %g; %g %g %g; %g %g %g); (fx s cx; 0 fy cy; 0 0 1) with positive focal lengths, or "
        "all 0, is expected",
        K.val[0], K.val[1], K.val[2], K.val[3], K.val[4], K.val[5], K.val[6], K.val[7], K.val[8]);
}

static void checkSize(const Size& size)
{
    REJECT_IF(size != Size() && (size.width <= 0 || size.height <= 0),
              "newSize is %d x %d; a positive width and height, or 0 x 0, are expected", size.width, size.height);
}

// The first and the last pixel of a row and of a column fix the focal lengths: they have to be two.
static void checkSpan(const Size& size)
{
    REJECT_IF(size.width < 2 || size.height < 2,
              "newSize is %d x %d; at least 2 x 2 is expected, as the focal lengths follow from the distance of the "
              "outermost pixels",
              size.width, size.height);
}

void WarpMapGenerator::Params::check() const
{
    checkNewCameraMatrix(newCameraMatrix);
    checkSize(newSize);
    REJECT_IF(maxIterations <= 0, "maxIterations is %d; a positive number is expected", maxIterations);
    REJECT_IF(!(tolerance > 0) || !std::isfinite(tolerance), "tolerance is %g; a positive number of pixels is expected",
              tolerance);
}

static int countPoints(const Mat& points)
{
    const int count = points.dims > 2 ? -1 : points.checkVector(2, -1, false);
    REJECT_IF(
        count < 0 || (points.depth() != CV_32F && points.depth() != CV_64F),
        "src is a %d x %d matrix of %d dimensions and type %s; N x 2, or N x 1 with two channels, CV_32F or CV_64F is "
        "expected",
        points.rows, points.cols, points.dims, typeToString(points.type()).c_str());
    return count;
}

static std::vector<Point2d> toPoints(const Mat& points)
{
    if (points.empty())
        return std::vector<Point2d>();
    const int count = countPoints(points);
    Mat converted;
    points.convertTo(converted, CV_64F);
    return converted.reshape(2, count);
}

static std::vector<double> toDepths(const Mat& depths, size_t count)
{
    if (depths.empty())
        return std::vector<double>();
    REJECT_IF(
        (depths.depth() != CV_32F && depths.depth() != CV_64F) || depths.dims > 2 ||
            depths.total() * depths.channels() != count,
        "depths has %d values of type %s in %d dimensions for %d points; one CV_32F or CV_64F value for each, in two "
        "dimensions, is expected",
        (int)(depths.total() * depths.channels()), typeToString(depths.type()).c_str(), depths.dims, (int)count);
    Mat converted;
    depths.convertTo(converted, CV_64F);
    return converted.reshape(1, int(count));
}

static void returnPlaces(const std::vector<Place>& places, const Mat& src, OutputArray dst, OutputArray mask)
{
    if (places.empty())
    {
        dst.release();
        if (mask.needed())
            mask.release();
        return;
    }
    const int count = int(places.size());
    Mat points(count, 2, CV_64F), exists(count, 1, CV_8U);
    for (int i = 0; i < count; i++)
    {
        const Point2d none(FAR_OUTSIDE, FAR_OUTSIDE);
        *points.ptr<Point2d>(i) = places[i].exists ? places[i].point : none;
        *exists.ptr(i) = places[i].exists ? 255 : 0;
    }
    points.reshape(src.channels(), src.rows).convertTo(dst, src.depth());
    if (mask.needed())
        exists.copyTo(mask);
}

namespace {

class WarpMapGeneratorImpl CV_FINAL : public StatelessAlgorithm<WarpMapGenerator>
{
public:
    WarpMapGeneratorImpl(const RollingShutterCamera& camera_, const Params& params_)
        : StatelessAlgorithm<WarpMapGenerator>(camera_, params_)
    {
    }

    void initRectifyMap(const AckermannMotion& motion, OutputArray map1, OutputArray map2, int m1type, OutputArray mask,
                        const DepthMap& depth) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        initMap(WARP_RECTIFY, motion, map1, map2, m1type, mask, depth);
    }

    void initDistortMap(const AckermannMotion& motion, OutputArray map1, OutputArray map2, int m1type, OutputArray mask,
                        const DepthMap& depth) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        initMap(WARP_DISTORT, motion, map1, map2, m1type, mask, depth);
    }

    void correctPoints(const AckermannMotion& motion, InputArray src, OutputArray dst, InputArray depths,
                       OutputArray mask) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        movePoints(rsackermann::correctPoints, motion, src, dst, depths, mask);
    }

    void distortPoints(const AckermannMotion& motion, InputArray src, OutputArray dst, InputArray depths,
                       OutputArray mask) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        movePoints(rsackermann::distortPoints, motion, src, dst, depths, mask);
    }

    Rect validRoi(const AckermannMotion& motion) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        checkMotion(motion);
        Mat mask(GlobalCamera(camera, params).size, CV_8UC1);
        MapWriter writer(camera.imageSize, mask);
        writeMap(WARP_RECTIFY, camera, params, motion, writer);
        return largestRectangle(mask);
    }

    Matx33d optimalNewCameraMatrix(const AckermannMotion& motion, double alpha, const Size& newSize) const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        checkMotion(motion);
        checkSize(newSize);
        REJECT_IF(!(alpha >= 0 && alpha <= 1), "alpha is %g; a number from 0 to 1 is expected", alpha);
        const GlobalCamera global(camera, params);
        const Size size = newSize == Size() ? global.size : newSize;
        checkSpan(size);
        return optimalMatrix(camera, motion, alpha, size, global.matrix);
    }

    String getDefaultName() const CV_OVERRIDE { return "rsackermann_WarpMapGenerator"; }

private:
    typedef void (*PointFunction)(const RollingShutterCamera&, const Params&, const Matx33d&, const AckermannMotion&,
                                  const std::vector<Point2d>&, const std::vector<double>&, std::vector<Place>&);

    void initMap(WarpDirection warp, const AckermannMotion& motion, OutputArray map1, OutputArray map2, int m1type,
                 OutputArray mask, const DepthMap& depth) const
    {
        checkMotion(motion);
        checkDepth(depth, camera, params);
        checkApart(map2, "map2", map1, "map1");
        checkApart(mask, "mask", map1, "map1");
        checkApart(mask, "mask", map2, "map2");
        checkApart(map1, "map1", depth.values, "depth.values");
        checkApart(map2, "map2", depth.values, "depth.values");
        m1type = normalizedMapType(m1type);
        Size size = GlobalCamera(camera, params).size, target = camera.imageSize;
        if (warp == WARP_DISTORT)
            std::swap(size, target);
        checkOutput(map1, "map1", size, m1type);
        if (m1type != CV_32FC2)
            checkOutput(map2, "map2", size, m1type == CV_16SC2 ? CV_16UC1 : CV_32FC1);
        if (mask.needed())
            checkOutput(mask, "mask", size, CV_8UC1);
        CV_OCL_RUN(depth.empty() && map1.isUMat() && (map2.isUMat() || m1type == CV_32FC2),
                   oclWarpMap(warp, camera, params, motion, m1type, map1, map2, mask))
        MapWriter writer(size, target, m1type, map1, map2, mask);
        if (depth.empty())
            writeMap(warp, camera, params, motion, writer);
        else
            writeDepthMap(warp, camera, params, motion, depth, writer);
    }

    void movePoints(PointFunction function, const AckermannMotion& motion, InputArray src_, OutputArray dst,
                    InputArray depths, OutputArray mask) const
    {
        checkMotion(motion);
        checkApart(mask, "mask", dst, "dst");
        const Mat src = matrixOf(src_, "src");
        const std::vector<Point2d> points = toPoints(src);
        if (!points.empty())
            checkOutput(dst, "dst", src.size(), src.type());
        if (mask.needed())
            checkOutput(mask, "mask", Size(1, int(points.size())), CV_8U);
        std::vector<Place> places;
        function(camera, params, GlobalCamera(camera, params).matrix, motion, points,
                 toDepths(matrixOf(depths, "depths"), points.size()), places);
        returnPlaces(places, src, dst, mask);
    }
};

} // namespace

Ptr<WarpMapGenerator> WarpMapGenerator::create(const RollingShutterCamera& camera, const Params& params)
{
    CV_INSTRUMENT_REGION();
    return makePtr<WarpMapGeneratorImpl>(camera, params);
}

Ptr<WarpMapGenerator> WarpMapGenerator::load(const String& filename, const String& objname)
{
    return StoredAlgorithm<WarpMapGenerator>::load(filename, objname);
}

}} // namespace cv::rsackermann
