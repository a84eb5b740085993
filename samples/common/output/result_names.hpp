// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_RESULT_NAMES_HPP
#define RSACKERMANN_SAMPLES_RESULT_NAMES_HPP

#include <string>

namespace rsackermann_samples {

/** Whether results go to a folder of that name: they do if there are several, or if the name is that of a folder.
@param option that has the name, for the message: throws UsageError if there are several and the name is that of a file.
*/
bool isResultFolder(const std::string& target, bool isSingle, const std::string& option);

//! Where a result goes; empty if it isn't wanted.
//! @param name without folders, for a result in a folder.
std::string resultPath(const std::string& target, bool isFolder, const std::string& name);

//! The name, without folders, of the picture of an input's segments.
std::string overlayName(const std::string& input);

//! Throws InputError if a file of that name can't be written: it is a folder, a pipe or a device, or exists and mustn't
//! be replaced.
void checkResult(const std::string& path, bool isReplaced);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_RESULT_NAMES_HPP
