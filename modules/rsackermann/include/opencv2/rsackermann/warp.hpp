// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_WARP_HPP
#define OPENCV_RSACKERMANN_WARP_HPP

#include "opencv2/rsackermann/depth_map.hpp"
#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

//! @addtogroup rsackermann
//! @{

/** @brief Makes maps for cv::remap that undo, or simulate, a rolling shutter.

The *global-shutter camera* sees what the rolling-shutter camera would see at the instant of the reference row, without
lens distortion. Its intrinsics and image size are those of the rolling-shutter camera unless others are set.

With a motion whose status isn't #MOTION_OK the maps undo (or simulate) the lens only.

Maps that are UMat are made with OpenCL. The processor makes them if there is a depth, or if the rows of the motion
pitch or roll (AckermannMotion::pitchRate, AckermannMotion::rollRate) or follow a curve
(AckermannMotion::rotationCurve), as those of sequences and with a gyro do.

All const methods, which are those that make maps and move points, may run at the same time in several threads on the
same object; the others need an object that no other thread uses meanwhile.
 */
class CV_EXPORTS_W WarpMapGenerator : public Algorithm
{
public:
    /** @brief Parameters of the maps.

    Const methods may run at the same time in several threads on the same object; changes need an object that no other
    thread uses meanwhile.
     */
    struct CV_EXPORTS_W_SIMPLE Params
    {
        CV_WRAP Params(); //!< the defaults
        //! Intrinsics of the global-shutter camera; all 0 (default): those of the camera
        CV_PROP_RW Matx33d newCameraMatrix;
        //! Image size of the global-shutter camera; 0 x 0 (default): that of the camera
        CV_PROP_RW Size newSize;
        CV_PROP_RW int maxIterations; //!< of the fixed point on the row time, default 10
        //! Pixels; the fixed point stops when a step changes the place by less, default 1e-3
        CV_PROP_RW double tolerance;

        //! Throws cv::Exception with the name and value of the first field that is out of range.
        CV_WRAP void check() const;

        //! Writes all fields into the present node, a map.
        void write(FileStorage& fs) const;
        //! The same for wrapped languages, in which a FileStorage is a pointer.
        CV_WRAP void write(const Ptr<FileStorage>& fs) const
        {
            CV_Assert(fs);
            write(*fs);
        }
        //! Reads the fields that write() has written; the others keep their values.
        CV_WRAP void read(const FileNode& fn);
    };

    /** @brief Creates a generator.
    @param camera the camera; copied.
    @param params see WarpMapGenerator::Params.
    @return the generator; throws cv::Exception if the camera or a parameter is out of range.
     */
    CV_WRAP static Ptr<WarpMapGenerator> create(const RollingShutterCamera& camera,
                                                const WarpMapGenerator::Params& params = WarpMapGenerator::Params());

    /** @brief Loads the camera and the parameters that Algorithm::save() has written.
    @param filename the file.
    @param objname name of the object in the file; empty: the first one.
    @return an object in the same state as one that was just created; throws cv::Exception if the file has none, or
    not all of what save() has written. A file written by hand, without the key "format", needs the camera; other
    parameters have their defaults.
     */
    CV_WRAP static Ptr<WarpMapGenerator> load(const String& filename, const String& objname = String());

    //! Sets another camera; throws cv::Exception if RollingShutterCamera::check() does.
    CV_WRAP virtual void setCamera(const RollingShutterCamera& camera) = 0;
    //! The present camera.
    CV_WRAP virtual RollingShutterCamera getCamera() const = 0;
    //! Sets other parameters; throws cv::Exception with the name and value of the first one that is out of range.
    CV_WRAP virtual void setParams(const WarpMapGenerator::Params& params) = 0;
    //! The present parameters.
    CV_WRAP virtual WarpMapGenerator::Params getParams() const = 0;

    /** @brief Maps that turn a rolling-shutter image into a global-shutter image: for each pixel of the global-shutter
    camera the place in the raw image.
    @param motion the motion.
    @param map1 first map, of the size of the global-shutter camera.
    @param map2 second map.
    @param m1type type of map1 with the meaning of cv::initUndistortRectifyMap: CV_32FC1, CV_32FC2 or CV_16SC2; 0 or
    less stands for CV_16SC2.
    @param mask receives a CV_8U mask, 255 where the pixel is seen in the raw image and 0 elsewhere; to 1/64 pixel, as
    cv::remap of OpenCV 4 rounds places to 1/32. With a depth #MASK_HIDDEN marks pixels that something hides. Maps,
    mask and depth are different matrices.
    @param depth see DepthMap, of the size of its camera's image; empty (default): the planes and the inverse-depth
    offset of the motion. A metric one needs what depths in correctPoints() need; throws cv::Exception otherwise.

    A pixel for which there is no place in the raw image (behind the camera, beyond the lens model, no convergence, at
    an instant at which the camera would have passed a wall, a coordinate beyond +-32767, where cv::remap finds nothing)
    is mapped to (-16384, -16384).

    With a depth, of several surfaces along a ray the nearest one counts. A pixel that the raw image doesn't show, as
    something in front of it hides it, is mapped to where the surface behind would be. With a depth of the raw camera a
    place outside of the raw image has the depth of the nearest pixel. Such maps are made by the processor, also for
    UMat.
     */
    CV_WRAP virtual void initRectifyMap(const AckermannMotion& motion, OutputArray map1, OutputArray map2,
                                        int m1type = CV_32FC1, OutputArray mask = noArray(),
                                        const DepthMap& depth = DepthMap()) const = 0;

    /** @brief Maps that turn a global-shutter image into a rolling-shutter image: for each pixel of the raw image the
    place in the image of the global-shutter camera.
    @param motion the motion.
    @param map1 first map, of the size of the raw image.
    @param map2 second map.
    @param m1type as in initRectifyMap().
    @param mask receives a CV_8U mask, 255 where the pixel is seen in the global-shutter image and 0 elsewhere, with a
    depth also #MASK_HIDDEN.
    @param depth as in initRectifyMap().

    A raw pixel sees the nearest plane along its ray, or infinity if the ray meets none, nearer or farther by the
    inverse-depth offset of the motion. The planes surround the camera without hiding one another, unless it passes a
    wall; rows at whose instant it would have done so are mapped to (-16384, -16384), and so are pixels for which the
    lens model has no ray or whose place has a coordinate beyond +-32767, or that could show two points of a steep
    offset.
     */
    CV_WRAP virtual void initDistortMap(const AckermannMotion& motion, OutputArray map1, OutputArray map2,
                                        int m1type = CV_32FC1, OutputArray mask = noArray(),
                                        const DepthMap& depth = DepthMap()) const = 0;

    /** @brief Moves points of the raw image to where the global-shutter camera sees them.
    @param motion the motion.
    @param src points in pixels of the raw image: N x 2 matrix, or N x 1 or 1 x N matrix with two channels, CV_32F or
    CV_64F.
    @param dst points in pixels of the global-shutter camera, of the size and type of src; (-16384, -16384) if there is
    none.
    @param depths metres along the optical axis of the global-shutter camera to each point, N values CV_32F or CV_64F;
    for points whose value is not positive, and without this argument, the planes and the inverse-depth offset of the
    motion are used. Depths need AckermannMotion::wallDistance, or AckermannMotion::roadSlope,
    RollingShutterCamera::height and an AckermannMotion::scale.
    @param mask receives an N x 1 matrix CV_8U, 255 for the points that have a place, be it inside of the image or not,
    and 0 for the others.

    A point has no place if a pixel at that point would have none in a map: a place with a coordinate beyond +-32767 is
    none.
     */
    CV_WRAP virtual void correctPoints(const AckermannMotion& motion, InputArray src, OutputArray dst,
                                       InputArray depths = noArray(), OutputArray mask = noArray()) const = 0;

    /** @brief Moves points of the global-shutter camera to where the raw image shows them; the inverse of
    correctPoints().
    @param motion the motion.
    @param src points in pixels of the global-shutter camera, as in correctPoints().
    @param dst points in pixels of the raw image, of the size and type of src; (-16384, -16384) if there is none.
    @param depths as in correctPoints().
    @param mask as in correctPoints().
     */
    CV_WRAP virtual void distortPoints(const AckermannMotion& motion, InputArray src, OutputArray dst,
                                       InputArray depths = noArray(), OutputArray mask = noArray()) const = 0;

    /** @brief The largest rectangle of the global-shutter image all of whose pixels are seen in the raw image.
    @param motion the motion.
    @return the rectangle in pixels of the global-shutter image; empty if there is none.
     */
    CV_WRAP virtual Rect validRoi(const AckermannMotion& motion) const = 0;

    /** @brief Camera matrix for Params::newCameraMatrix that shows more or less of the raw image, as
    cv::getOptimalNewCameraMatrix makes it for the lens alone.
    @param motion the motion; AckermannMotion() for a matrix that stays the same from frame to frame.
    @param alpha 0: all pixels of the global-shutter image are seen in the raw image; 1: all pixels of the raw image are
    seen in the global-shutter image; between them a mixture.
    @param newSize image size of the global-shutter camera, at least 2 x 2; 0 x 0: Params::newSize.
    @return the matrix; the present one of the global-shutter camera if a border of the raw image has no place in it.
     */
    CV_WRAP virtual Matx33d optimalNewCameraMatrix(const AckermannMotion& motion, double alpha,
                                                   const Size& newSize = Size()) const = 0;
};

//! @}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_WARP_HPP
