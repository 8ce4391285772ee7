/* Start-up for the test on QEMU's mps2-an386: the answer of test() becomes the exit status of the machine. */
#include <stdint.h>

extern uint32_t _stack_top;
int test(void);
void reset(void);

__attribute__((section(".vectors"), used)) static const void *const vectors[2] = {&_stack_top, (const void *)reset};

static void leave(uint32_t status)
{
    /* SYS_EXIT_EXTENDED, application exit. */
    uint32_t block[2] = {0x20026u, status};
    register uint32_t operation __asm__("r0") = 0x20;
    register uint32_t *argument __asm__("r1") = block;
    __asm__ volatile("bkpt 0xAB" : : "r"(operation), "r"(argument) : "memory");
}

void reset(void)
{
    /* The floating-point unit: full access to coprocessors 10 and 11. */
    *(volatile uint32_t *)0xE000ED88u |= 0x00F00000u;
    __asm__ volatile("dsb\n isb");
    leave((uint32_t)test());
    for (;;) {
    }
}
