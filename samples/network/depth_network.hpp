// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_DEPTH_NETWORK_HPP
#define RSACKERMANN_SAMPLES_DEPTH_NETWORK_HPP

#include "opencv2/dnn.hpp"
#include "options.hpp"

namespace rsackermann_samples {

//! What a network takes: an image of a size, with (value - mean) * scale for values from 0 to 255.
struct NetworkInput
{
    cv::Size size;
    cv::Vec3d mean, scale; //!< of red, green and blue
    bool isBgr;            //!< blue goes first, not red
};

//! Keys of the options that readNetworkInput() takes.
extern const char* const NETWORK_KEYS;

//! Reads the options for the input, whose defaults are those of well-known networks.
NetworkInput readNetworkInput(const Options& options);

//! A network that makes a depth, or an inverse depth, of each pixel from an image.
class DepthNetwork
{
public:
    //! Reads an ONNX file with one output; throws InputError.
    DepthNetwork(const std::string& path, const NetworkInput& input);

    /** What the network says of an image; throws InputError.
    @param image of 8 or 16 bits with one, three or four channels.
    @return the output, scaled to the image's size. */
    cv::Mat1f run(const cv::Mat& image);

private:
    std::string path_;
    NetworkInput input_;
    cv::dnn::Net net_;
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_DEPTH_NETWORK_HPP
