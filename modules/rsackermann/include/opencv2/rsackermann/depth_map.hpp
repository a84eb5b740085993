// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_DEPTH_MAP_HPP
#define OPENCV_RSACKERMANN_DEPTH_MAP_HPP

#include "opencv2/rsackermann/camera.hpp"

namespace cv { namespace rsackermann {

//! @addtogroup rsackermann
//! @{

//! The camera that a depth map belongs to.
enum DepthCamera {
    //! The raw image, each row at its own instant and through the lens, as stereo or a network sees it (default)
    DEPTH_RAW = 0,
    DEPTH_CORRECTED = 1 //!< the global-shutter camera of the maps, at the instant of the reference row
};

//! What the values of a depth map are.
enum DepthKind {
    DEPTH_METRIC = 0, //!< depths along the optical axis, in units of DepthMap::scale metres (default)
    //! Inverse depths along the optical axis up to an unknown scale and shift, larger where the scene is nearer, as
    //! many networks give them
    DEPTH_RELATIVE = 1
};

//! What the mask of a map with a depth says of a pixel.
enum MaskValue {
    MASK_OUTSIDE = 0,  //!< its place is outside of the other image, or it has none
    MASK_HIDDEN = 128, //!< something in front of it hides it from the other camera
    MASK_SEEN = 255    //!< the other image shows it
};

/** @brief A given depth of the scene, pixel by pixel: from stereo, a network, a lidar or a renderer.

A #DEPTH_METRIC is known where its value is positive and finite, a #DEPTH_RELATIVE where it is finite. Unknown, too, is
what is nearer than twice the way that the camera moves during the read-out before or after the reference row. There the
planes and the inverse-depth offset of the motion count, shifted towards what is known around.

RollingShutterCorrector::correct() finds scale and shift of a #DEPTH_RELATIVE; maps and correctWithMotion() take them as
they are.

Const methods may run at the same time in several threads on the same object; changes need an object that no other
thread uses meanwhile.
 */
class CV_EXPORTS_W_SIMPLE DepthMap
{
public:
    CV_WRAP DepthMap(); //!< nothing is known

    /** @brief Wraps values without copying or checking them.
    @param values as in DepthMap::values.
    @param camera one of #DepthCamera.
    @param scale as DepthMap::scale.
    @param kind one of #DepthKind.
     */
    CV_WRAP explicit DepthMap(const Mat& values, int camera = DEPTH_RAW, double scale = 1, int kind = DEPTH_METRIC);

    /** @brief A depth that is known where there are points: of a lidar, or of structure from motion.

    One pixel in a hundred is nearly as good as all of them: between points the planes count, shifted towards what is
    known around. Throws cv::Exception if the points are of another type or the camera is invalid.
    @param points metres in the frame of the global-shutter camera, at the instant of its reference row (x to the right,
    y down, z along the optical axis): N x 3 matrix, or N x 1 or 1 x N with three channels, CV_32F or CV_64F. The
    nearest point of a pixel counts; one that isn't finite, in front of the camera and in its image doesn't.
    @param camera whose matrix and image size are those of the global-shutter camera.
    @return a metric depth of #DEPTH_CORRECTED, CV_32F; 0 where there is no point.
     */
    CV_WRAP static DepthMap fromPoints(InputArray points, const RollingShutterCamera& camera);

    //! Whether there are no values.
    CV_WRAP bool empty() const;

    //! Throws cv::Exception with the name and value of the first field that is out of range; an empty map is none.
    CV_WRAP void check() const;

    //! One value for each pixel of the camera's image, CV_32FC1 or CV_16UC1
    CV_PROP_RW Mat values;
    CV_PROP_RW int camera; //!< one of #DepthCamera, default #DEPTH_RAW
    CV_PROP_RW int kind;   //!< one of #DepthKind, default #DEPTH_METRIC
    //! Of a metric depth metres per unit of the values, default 1; 0.001 for millimetres. Of a relative one what
    //! multiplies the values: scale * value + shift is the scaled inverse depth (AckermannMotion) without its sign, 1
    //! over the depth in the unit of length in which the car drives 1 per unit of row time
    CV_PROP_RW double scale;
    CV_PROP_RW double shift; //!< of a relative depth, see scale; default 0
    //! Standard deviation of the scale of a metric depth, and of errors that large parts of an image share, relative,
    //! from 0 to 1: 0.1 (default) of a network that gives metres, 0.01 or less of stereo or a lidar. With it a sequence
    //! finds the scale, and a single image is expected to be left with what it leaves
    CV_PROP_RW double scaleSigma;
};

//! @}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_DEPTH_MAP_HPP
