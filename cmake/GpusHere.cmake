# Sets OCTOCELL_GPUS_HERE, the shortest list of architectures that runs here: machine code for this
# machine's GPUs, or, where there is none, PTX that a driver translates for anything from Turing on.
set(OCTOCELL_GPUS_HERE 75-virtual)
find_program(OCTOCELL_NVIDIA_SMI nvidia-smi)
mark_as_advanced(OCTOCELL_NVIDIA_SMI)
if(OCTOCELL_NVIDIA_SMI)
  execute_process(COMMAND ${OCTOCELL_NVIDIA_SMI} --query-gpu=compute_cap --format=csv,noheader
                  OUTPUT_VARIABLE capabilities ERROR_QUIET RESULT_VARIABLE failed)
  string(REGEX MATCHALL "[0-9]+\\.[0-9]+" capabilities "${capabilities}")
  if(NOT failed AND capabilities)
    list(REMOVE_DUPLICATES capabilities)
    list(TRANSFORM capabilities REPLACE "\\." "")
    list(TRANSFORM capabilities APPEND "-real")
    set(OCTOCELL_GPUS_HERE ${capabilities})
  endif()
endif()
