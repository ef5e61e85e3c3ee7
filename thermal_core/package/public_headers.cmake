# Which headers users get: those of the libraries in `floors`, but for `left_out` (headers and folders, or how their
# names begin), which show types of a library that stays private.
set(floors base radiometry heat scene raycast sensor labels imaging io dataset analysis)
set(left_out
    base/happens_before.h
    dataset/videos/cell_painter.h
    io/exr/file.h io/exr/pixels.h
    io/image/module/ io/image/picture_module.h
    io/video/ffmpeg.h
    raycast/embree.h raycast/first_hit.h raycast/frame_tracer.h raycast/mirrors.h raycast/scene_accelerator.h
    raycast/refinement.h)
