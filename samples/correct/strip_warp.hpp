// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_STRIP_WARP_HPP
#define RSACKERMANN_SAMPLES_STRIP_WARP_HPP

#include "opencv2/rsackermann.hpp"

namespace rsackermann_samples {

/** Warps images strip by strip, so that of the maps, which need three times the memory of an image, only those of a
strip exist.

The corrected image has the size and the camera matrix of the raw one.
*/
class StripWarp
{
public:
    explicit StripWarp(const cv::rsackermann::RollingShutterCamera& camera);

    //! Sets a camera that differs in its upright rotation only.
    void setCamera(const cv::rsackermann::RollingShutterCamera& camera) { generator_->setCamera(camera); }

    /** Corrects an image.
    @param depth empty: none is given. With one the image is warped in one piece, as every strip would need all of it.
    @param seconds receives the times for maps and remapping. */
    void correct(const cv::Mat& image, const cv::rsackermann::AckermannMotion& motion,
                 const cv::rsackermann::DepthMap& depth, cv::Mat& corrected, cv::Vec2d& seconds);

    //! The maps with which correct() remaps.
    void maps(const cv::rsackermann::AckermannMotion& motion, const cv::rsackermann::DepthMap& depth, cv::Mat& map1,
              cv::Mat& map2);

    //! Whether a camera at rest needs no correction, as it has no lens distortion.
    bool hasNoLens() const;

    //! Parameters for maps of every eighth pixel of every eighth row.
    static cv::rsackermann::WarpMapGenerator::Params coarse(const cv::rsackermann::RollingShutterCamera& camera);
    //! The depth for such maps.
    static cv::rsackermann::DepthMap coarse(const cv::rsackermann::DepthMap& depth);

private:
    template <class Use>
    void forEachStrip(const cv::rsackermann::AckermannMotion& motion, const cv::rsackermann::DepthMap& depth,
                      const Use& use);

    cv::Ptr<cv::rsackermann::WarpMapGenerator> generator_;
    cv::Mat map1_, map2_; // of a strip
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_STRIP_WARP_HPP
