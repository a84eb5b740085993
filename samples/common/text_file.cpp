// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "text_file.hpp"

namespace rsackermann_samples {

std::ifstream openText(const std::string& path)
{
    const std::string mark = "\xEF\xBB\xBF";
    std::ifstream file(path.c_str(), std::ios::binary);
    size_t read = 0;
    while (read < mark.size() && file.peek() == (unsigned char)mark[read]) // a folder fails here
    {
        file.get();
        read++;
    }
    if (read < mark.size())
        for (; read > 0; read--)
            file.unget();
    return file;
}

} // namespace rsackermann_samples
