// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_CONTAINER_BYTES_HPP
#define RSACKERMANN_SAMPLES_CONTAINER_BYTES_HPP

#include "opencv2/core.hpp"
#include <cstdint>
#include <fstream>
#include <string>

namespace rsackermann_samples {

//! Reads a file here and there.
class Bytes
{
public:
    explicit Bytes(const std::string& path);

    uint64_t size() const { return size_; }

    //! False at the end of the file.
    bool read(uint64_t at, uchar* bytes, size_t count);

private:
    std::ifstream file_;
    const uint64_t size_;
};

uint64_t bigEndian(const uchar* bytes, int count);

enum ContainerFormat {
    CONTAINER_OTHER,
    CONTAINER_RIFF, //!< AVI
    CONTAINER_BOX,  //!< MP4 and MOV
    CONTAINER_EBML  //!< Matroska and WebM
};
ContainerFormat containerFormat(Bytes& file);

//! A part of a container with a name: a box of MP4 and MOV, an element of Matroska and WebM.
struct ContainerPart
{
    uint64_t name;       //!< its bytes
    uint64_t begin, end; //!< of the content; end may be beyond that of the file
    bool isEndless;      //!< it states no size and goes on to the end
};

//! The part that begins there; false if there is none, or less than its head.
bool readBox(Bytes& file, uint64_t at, ContainerPart& part);
bool readElement(Bytes& file, uint64_t at, ContainerPart& part);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_CONTAINER_BYTES_HPP
