// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../shutter_geometry.hpp"
#include "maps.hpp"

#ifdef HAVE_OPENCL

#include "opencl_kernels_rsackermann.hpp"

namespace cv { namespace rsackermann {

// The same as in opencl/warp_map.cl, where the formulas stand again in single precision; test_warp_ocl.cpp compares the
// maps of both.
struct KernelWarp
{
    float newFx, newFy, newCx, newCy, newSkew;
    float fx, fy, cx, cy;
    float k[12];
    float tilt[9];
    float maxRadius2;
    float up[9];
    float B, D, lambda, G, direction;
    float offsetX, offsetY, cellsPerX, cellsPerY;
    int offsetColumns, offsetRows;
    float alpha, cosHeading, sinHeading;
    float reference, timeStep;
    float timeTolerance;
    int byRows;
    int maxIterations;
    int width, height;
};
static_assert(sizeof(KernelWarp) == 61 * sizeof(float), "a kernel's struct has no padding");

static KernelWarp kernelWarp(WarpDirection warp, const RollingShutterCamera& camera,
                             const WarpMapGenerator::Params& params, const AckermannMotion& motion)
{
    const GlobalCamera global(camera, params);
    const Lens<float> lens(camera);
    const Matx33f tilt(lens.tilt);
    const Matx33f up = motion.uprightRotation(camera), usedTilt = warp == WARP_RECTIFY ? tilt : tilt.inv();
    const Scene scene(motion);
    const Size target = warp == WARP_RECTIFY ? camera.imageSize : global.size;

    KernelWarp r;
    r.newFx = float(global.matrix(0, 0));
    r.newFy = float(global.matrix(1, 1));
    r.newCx = float(global.matrix(0, 2));
    r.newCy = float(global.matrix(1, 2));
    r.newSkew = float(global.matrix(0, 1));
    r.fx = lens.fx;
    r.fy = lens.fy;
    r.cx = lens.cx;
    r.cy = lens.cy;
    std::copy(lens.k, lens.k + 12, r.k);
    std::copy(usedTilt.val, usedTilt.val + 9, r.tilt);
    r.maxRadius2 = lens.maxRadius2;
    std::copy(up.val, up.val + 9, r.up);
    r.B = float(scene.B);
    r.D = float(scene.D);
    r.lambda = float(scene.lambda);
    r.G = float(scene.G);
    r.direction = float(scene.direction);
    const Rect2d& area = motion.offsetArea;
    const Size cells = InverseDepthOffset(motion).cells();
    r.offsetX = float(area.x);
    r.offsetY = float(area.y);
    r.cellsPerX = float(cells.width / area.width);
    r.cellsPerY = float(cells.height / area.height);
    r.offsetColumns = motion.inverseDepthOffset.cols;
    r.offsetRows = motion.inverseDepthOffset.rows;
    r.alpha = float(motion.alpha);
    r.cosHeading = float(std::cos(motion.heading(camera)));
    r.sinHeading = float(std::sin(motion.heading(camera)));
    r.reference = float(camera.referenceRow);
    r.timeStep = float(camera.rowTime(Point2d(1, 1)) - camera.rowTime(Point2d(0, 0)));
    // Finer than the spacing of single-precision pixel coordinates the row can't get.
    r.timeTolerance = std::max(float(params.tolerance), 1e-4f) * std::abs(r.timeStep);
    r.byRows = camera.isRowShutter();
    r.maxIterations = params.maxIterations;
    r.width = target.width;
    r.height = target.height;
    return r;
}

static String buildOptions(WarpDirection warp, const Lens<float>& lens, const AckermannMotion& motion, int m1type,
                           bool mask)
{
    const bool moving = motion.status == MOTION_OK;
    String options = warp == WARP_RECTIFY ? "-D RECTIFY" : "-D DISTORT";
    options += m1type == CV_32FC1 ? " -D MAP_32FC1" : m1type == CV_32FC2 ? " -D MAP_32FC2" : " -D MAP_16SC2";
    if (lens.kind == Lens<float>::BROWN)
        options += " -D LENS_BROWN";
    if (lens.kind == Lens<float>::FISHEYE)
        options += " -D LENS_FISHEYE";
    if (lens.tilted)
        options += " -D TILTED";
    if (moving)
        options += " -D MOVING";
    if (moving && !motion.inverseDepthOffset.empty())
        options += " -D RELIEF";
    if (mask)
        options += " -D MASK";
    return options;
}

bool oclWarpMap(WarpDirection warp, const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
                const AckermannMotion& motion, int m1type, OutputArray map1_, OutputArray map2_, OutputArray mask_)
{
    // The kernel knows rows that turn to the right or left alone.
    if (motion.status == MOTION_OK && !RowTilt(camera, motion).isNone())
        return false;
    ocl::Kernel kernel("warpMap", ocl::rsackermann::warp_map_oclsrc,
                       buildOptions(warp, Lens<float>(camera), motion, m1type, mask_.needed()));
    if (kernel.empty())
        return false;

    const Size size = warp == WARP_RECTIFY ? GlobalCamera(camera, params).size : camera.imageSize;
    map1_.create(size, m1type);
    UMat map1 = map1_.getUMat(), map2, mask;
    int index = kernel.set(0, ocl::KernelArg::WriteOnlyNoSize(map1));
    if (m1type == CV_32FC2)
        map2_.release();
    else
    {
        map2_.create(size, m1type == CV_16SC2 ? CV_16UC1 : CV_32FC1);
        map2 = map2_.getUMat();
        index = kernel.set(index, ocl::KernelArg::WriteOnlyNoSize(map2));
    }
    if (mask_.needed())
    {
        if (mask_.isUMat())
        {
            mask_.create(size, CV_8UC1);
            mask = mask_.getUMat();
        }
        else
            mask.create(size, CV_8UC1);
        index = kernel.set(index, ocl::KernelArg::WriteOnlyNoSize(mask));
    }
    UMat offset;
    if (motion.status == MOTION_OK && !motion.inverseDepthOffset.empty())
    {
        motion.inverseDepthOffset.convertTo(offset, CV_32F);
        index = kernel.set(index, ocl::KernelArg::PtrReadOnly(offset));
    }
    index = kernel.set(index, size.height);
    index = kernel.set(index, size.width);
    const KernelWarp w = kernelWarp(warp, camera, params, motion);
    kernel.set(index, &w, sizeof(w));

    size_t globalSize[] = {(size_t)size.width, (size_t)size.height};
    if (!kernel.run(2, globalSize, NULL, false))
        return false;
    if (mask_.needed() && !mask_.isUMat())
        mask.copyTo(mask_);
    return true;
}

}} // namespace cv::rsackermann

#endif // HAVE_OPENCL
