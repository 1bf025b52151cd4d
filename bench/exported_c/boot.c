/* Starts main on QEMU's machine mps2-an500, a Cortex-M7 of 25 MHz without an operating system, and
   prints how many ticks of its clock STEPS steps took. With -icount shift=0 an instruction takes
   1 ns, so that a tick is 40 instructions. */
#include <stdint.h>

#define AS_TEXT(x) #x
#define TEXT(x) AS_TEXT(x)
enum { write0 = 0x04, exit_program = 0x18, exit_in_order = 0x20026 };

extern uint32_t stack_top;
int main(int count, char** arguments);
void reset(void);

__attribute__((section(".vectors"), used)) void* const vectors[] = {&stack_top, (void*)reset};

static void ask_host(int what, const void* with) {
  register int operation __asm__("r0") = what;
  register const void* argument __asm__("r1") = with;
  __asm__ volatile("bkpt 0xab" : "+r"(operation) : "r"(argument) : "memory");
}

static void print(uint32_t number) {
  char text[12];
  int i = sizeof text;
  text[--i] = '\0';
  text[--i] = '\n';
  do {
    text[--i] = (char)('0' + number % 10);
    number /= 10;
  } while (number > 0);
  ask_host(write0, text + i);
}

void reset(void) {
  volatile uint32_t* const clock = (volatile uint32_t*)0xE000E010; /* SysTick, 24 bits, down */
  *(volatile uint32_t*)0xE000ED88 |= 0xFu << 20;                   /* turns on the FPU */
  __asm__ volatile("dsb\n isb");
  clock[1] = 0xFFFFFF;
  clock[2] = 0;
  clock[0] = 5;
  char* arguments[] = {"steps", TEXT(STEPS)};
  const uint32_t before = clock[2];
  const int failed = main(2, arguments);
  const uint32_t after = clock[2];
  print(failed ? 0 : (before - after) & 0xFFFFFF);
  ask_host(exit_program, (const void*)exit_in_order);
  for (;;) {
  }
}
