// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_FRAME_CORRECTOR_HPP
#define RSACKERMANN_SAMPLES_FRAME_CORRECTOR_HPP

#include "job.hpp"
#include "repeated_images.hpp"
#include "report.hpp"
#include "strip_warp.hpp"
#include <memory>

namespace rsackermann_samples {

//! The result of an image.
struct CorrectedFrame
{
    FrameReport report;                 //!< all but the input's name
    cv::Mat image, overlay, map1, map2; //!< empty if the job doesn't ask for them
};

//! The image after one that is corrected; empty: not known.
struct NextFrame
{
    cv::Mat image;
    double time; //!< seconds; NaN: unknown

    NextFrame() : time(0) {}
    NextFrame(const cv::Mat& image_, double time_) : image(image_), time(time_) {}
};

//! Corrects images one by one, as the job says.
class FrameCorrector
{
public:
    explicit FrameCorrector(const Job& job) : job_(job), gyroDelay_(0), roll_(0), pitch_(0) { reset(); }

    /** Goes on to the next image of a sequence, whether it can be corrected or not: its time passes.
    @param facts from the log, or only its time. */
    void beginFrame(const FrameFacts& facts);

    //! Seconds at which the image after the present one was taken, known or assumed.
    double timeAfter(const FrameFacts& facts) const;

    //! Whether the image after the one that is corrected next says something: for the first one of a drive, which has
    //! none before.
    bool wantsNext() const { return job_.params.sequence && (isFirst_ || job_.smooth); }

    /** Corrects the image; throws InputError or cv::Exception.
    @param next see wantsNext().
    @param depthFile empty: none is given. */
    CorrectedFrame correct(const cv::Mat& image, const NextFrame& next = NextFrame(),
                           const std::string& depthFile = "");

    //! What takes the place of an image in a video that correct() has failed on: only the lens is undone.
    CorrectedFrame uncorrected(const cv::Mat& image, const std::string& error);

    //! The next image belongs to another sequence.
    void reset();

    //! The clock of the gyro is ahead of that of the frames to come. @param delay seconds.
    void setGyroDelay(double delay);

    //! How far the frames up to now show that it is ahead; 0: they contradict the gyro.
    double gyroDelay() const;

private:
    void prepare(const cv::Size& size);
    void useFacts();
    bool contradictsGyro() const;
    void warp(const cv::Mat& image, const cv::rsackermann::DepthMap& depth, CorrectedFrame& frame);

    const Job& job_;
    bool isFirst_; // of a sequence
    double gyroDelay_;
    FrameFacts facts_;                                            // of the present image
    double time_;                                                 // of it, known or assumed
    cv::rsackermann::RollingShutterCamera camera_;                // of the last image
    cv::Ptr<cv::rsackermann::RollingShutterCorrector> corrector_; // its image and maps have every eighth pixel only
    double roll_, pitch_;                                         // degrees, of the camera
    ImageChange change_;
    std::unique_ptr<StripWarp> warp_;
    cv::Mat lensMap1_, lensMap2_; // undo the lens only, for every eighth pixel
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_FRAME_CORRECTOR_HPP
