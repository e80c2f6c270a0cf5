/* The same for kernels in C and their data, see names.h. */
#ifndef KERNELS_H
#define KERNELS_H

#include "model.h"

#define model_memory_any OWN(model_memory_any)
#define model_size_any OWN(model_size_any)
#define model_prepare_any OWN(model_prepare_any)
#define model_start_any OWN(model_start_any)
#define model_outputs_any OWN(model_outputs_any)
#define model_lazy_any OWN(model_lazy_any)
#define model_difference_any OWN(model_difference_any)
#define model_field_any OWN(model_field_any)
#define model_data0 OWN(model_data0)
#define model_data1 OWN(model_data1)
#define model_data2 OWN(model_data2)
#define model_data3 OWN(model_data3)
#define model_data4 OWN(model_data4)
#define model_data5 OWN(model_data5)
#define model_data6 OWN(model_data6)
#define model_data7 OWN(model_data7)
#define model_data8 OWN(model_data8)
#define model_data9 OWN(model_data9)

#endif
