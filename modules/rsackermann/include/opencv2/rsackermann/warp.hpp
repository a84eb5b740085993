// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_WARP_HPP
#define OPENCV_RSACKERMANN_WARP_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv {
namespace rsackermann {

//! @addtogroup rsackermann
//! @{

/** @brief Makes maps for cv::remap that undo, or simulate, a rolling shutter.

The *global-shutter camera* sees what the rolling-shutter camera would see at the instant of the reference row, without
lens distortion. Its intrinsics and image size are those of the rolling-shutter camera unless others are set.

With a motion whose status isn't #MOTION_OK the maps undo (or simulate) the lens only.
 */
class CV_EXPORTS_W WarpMapGenerator : public Algorithm
{
public:
    struct CV_EXPORTS_W_SIMPLE Params
    {
        CV_WRAP Params();
        CV_PROP_RW Matx33d newCameraMatrix; //!< intrinsics of the global-shutter camera; all 0 (default): those of the camera
        CV_PROP_RW Size newSize;            //!< image size of the global-shutter camera; 0 x 0 (default): that of the camera
        CV_PROP_RW int maxIterations;       //!< of the fixed point on the row time, default 10
        CV_PROP_RW double tolerance;        //!< pixels; the fixed point stops where the row changes by less, default 1e-3

        void write(FileStorage& fs) const;
        //! Reads what write() has written. Fields that are missing keep their values.
        void read(const FileNode& fn);
    };

    /** @brief Creates a generator.
    @param camera the camera; copied.
    @param params see WarpMapGenerator::Params.
     */
    CV_WRAP static Ptr<WarpMapGenerator> create(const RollingShutterCamera& camera,
                                                const WarpMapGenerator::Params& params = WarpMapGenerator::Params());

    CV_WRAP virtual void setCamera(const RollingShutterCamera& camera) = 0;
    CV_WRAP virtual RollingShutterCamera getCamera() const = 0;
    CV_WRAP virtual void setParams(const WarpMapGenerator::Params& params) = 0;
    CV_WRAP virtual WarpMapGenerator::Params getParams() const = 0;

    /** @brief Maps that turn a rolling-shutter image into a global-shutter image: for each pixel of the global-shutter camera
    the place in the raw image.
    @param motion the motion.
    @param map1 first map, of the size of the global-shutter camera.
    @param map2 second map.
    @param m1type type of map1: CV_32FC1 or CV_32FC2, with the meaning of cv::initUndistortRectifyMap.
    @param mask receives a CV_8U mask, 255 where the pixel is seen in the raw image and 0 elsewhere.

    A pixel for which there is no place in the raw image (behind the camera, no convergence) is mapped far outside.
     */
    CV_WRAP virtual void initRectifyMap(const AckermannMotion& motion, OutputArray map1, OutputArray map2, int m1type = CV_32FC1,
                                        OutputArray mask = noArray()) const = 0;

    /** @brief Maps that turn a global-shutter image into a rolling-shutter image: for each pixel of the raw image the place in
    the image of the global-shutter camera.
    @param motion the motion.
    @param map1 first map, of the size of the raw image.
    @param map2 second map.
    @param m1type as in initRectifyMap().
    @param mask receives a CV_8U mask, 255 where the pixel is seen in the global-shutter image and 0 elsewhere.
     */
    CV_WRAP virtual void initDistortMap(const AckermannMotion& motion, OutputArray map1, OutputArray map2, int m1type = CV_32FC1,
                                        OutputArray mask = noArray()) const = 0;
};

//! @}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_WARP_HPP
