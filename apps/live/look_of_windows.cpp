#include "look_of_windows.h"

#include "ostia/core/error.h"

#include <backends/imgui_impl_opengl3.h>

#include <filesystem>

namespace ostia::live {
namespace {

constexpr const char* font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float font_px = 14.0F;

void set_style() {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0.0F;
  style.WindowBorderSize = 0.0F;
  style.FrameRounding = 3.0F;
  style.GrabRounding = 3.0F;
  style.WindowPadding = {12.0F, 10.0F};
  style.ItemSpacing = {8.0F, 6.0F};
  style.Colors[ImGuiCol_WindowBg] = {0.105F, 0.115F, 0.13F, 1.0F};
  style.Colors[ImGuiCol_Text] = {0.90F, 0.91F, 0.93F, 1.0F};
  const ImVec4 frame{0.18F, 0.20F, 0.23F, 1.0F}, hovered{0.24F, 0.28F, 0.33F, 1.0F},
      pressed{0.20F, 0.40F, 0.58F, 1.0F};
  for (const int part : {ImGuiCol_FrameBg, ImGuiCol_Button}) style.Colors[part] = frame;
  for (const int part : {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered}) style.Colors[part] = hovered;
  for (const int part : {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive}) style.Colors[part] = pressed;
  style.Colors[ImGuiCol_CheckMark] = accent_color;
  // the number behind the grab is to be read
  for (const int part : {ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive})
    style.Colors[part] = {accent_color.x, accent_color.y, accent_color.z, 0.55F};
}

}  // namespace

Windows::Windows() {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  std::error_code ignored;
  if (std::filesystem::exists(font, ignored)) io.Fonts->AddFontFromFileTTF(font, font_px);
  set_style();
  if (!ImGui_ImplOpenGL3_Init("#version 330 core")) {
    ImGui::DestroyContext();
    throw ResourceError("the panel's part of OpenGL cannot be started: libGL.so.1 is missing or too old");
  }
}

Windows::~Windows() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

}  // namespace ostia::live
